// The files that are given together with a tree's own: which trees they have, and reading those that it uses.
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/elements.hpp"

namespace swiftlet::tree {

namespace fs = std::filesystem;

const std::string* Documents::fileElsewhere(const Document& document, const std::string& id) const {
  const auto known = options_.trees_elsewhere.find(id);
  if (known == options_.trees_elsewhere.end()) return nullptr;
  const fs::path folder = fs::path(document.source.file()).parent_path();
  const auto isBeside = [&](const std::string& file) { return fs::path(file).parent_path() == folder; };
  const auto beside = std::find_if(known->second.begin(), known->second.end(), isBeside);
  return beside == known->second.end() ? &known->second.front() : &*beside;
}

std::string Documents::includeFor(const Document& document, const std::string& id) const {
  const std::string* file = fileElsewhere(document, id);
  if (file == nullptr) return {};
  const std::string from_here =
      fs::path(*file).lexically_relative(fs::path(document.source.file()).parent_path()).generic_string();
  return "write <include path=\"" + (from_here.empty() ? *file : from_here) + "\"/> below <root>";
}

void Documents::readElsewhere(const Document& main_file) {
  std::vector<std::string> wanted;
  if (const std::string* id = main_file.root.attribute("main_tree_to_execute")) wanted.push_back(*id);
  for (const auto& document : documents)
    for (std::string& id : subTreesOf(document->root)) wanted.push_back(std::move(id));
  is_elsewhere_ = true;
  while (!wanted.empty() && !problems_.full()) {
    const std::string id = std::move(wanted.back());
    wanted.pop_back();
    const std::string* file = trees.contains(id) ? nullptr : fileElsewhere(main_file, id);
    if (file == nullptr || isRead(*file)) continue;
    const std::size_t before = documents.size();
    if (auto text = read_file_(*file)) lost_a_tree_ = !add(std::move(*text), *file, nullptr, nullptr) || lost_a_tree_;
    for (std::size_t i = before; i < documents.size(); ++i)
      for (std::string& other : subTreesOf(documents[i]->root)) wanted.push_back(std::move(other));
  }
  is_elsewhere_ = false;
}

TreeFiles treeFiles(const std::vector<std::string>& paths) {
  TreeFiles files;
  for (const std::string& path : paths) {
    ParseOptions options;
    options.lenient = true;
    Problems ignored(options.limits.problems);
    Documents documents(options, ignored);
    documents.load(path);
    for (const auto& [id, tree] : documents.trees)
      if (tree.document->source.file() == path) files[id].push_back(path);
  }
  return files;
}

}  // namespace swiftlet::tree
