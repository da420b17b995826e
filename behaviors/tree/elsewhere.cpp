// The files that are given together with a tree's own: which trees they have, and reading those that it uses.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/elements.hpp"

namespace swiftlet::tree {

namespace fs = std::filesystem;

const std::string* Documents::fileElsewhere(const Document& document, const std::string& id) const {
  const auto known = options_.trees_elsewhere.trees.find(id);
  if (known == options_.trees_elsewhere.trees.end()) return nullptr;
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
  return fmt::format("write <include path=\"{}\"/> below <root>", from_here.empty() ? *file : from_here);
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

namespace {

/// What one of the files says of trees.
struct FileOfTrees {
  std::string path;
  std::string main_id;                    ///< Empty: it names no main tree.
  std::map<std::string, Location> trees;  ///< That it defines itself.
  std::set<std::string> uses;             ///< That its SubTrees name.
};

FileOfTrees fileOfTrees(const std::string& path) {
  ParseOptions options;
  options.lenient = true;
  Problems ignored(options.limits.problems);
  Documents documents(options, ignored);
  documents.load(path);
  FileOfTrees file{path, {}, {}, {}};
  for (const auto& [id, tree] : documents.trees)
    if (tree.document->source.file() == path) file.trees[id] = tree.document->at(*tree.element);
  for (const auto& document : documents.documents) {
    if (document->source.file() != path) continue;
    if (const std::string* id = document->root.attribute("main_tree_to_execute")) file.main_id = *id;
    for (std::string& id : subTreesOf(document->root)) file.uses.insert(std::move(id));
  }
  return file;
}

bool isUsed(const FileOfTrees& file, const std::set<std::string>& used) {
  if (!file.main_id.empty()) return file.trees.contains(file.main_id) && used.contains(file.main_id);
  return std::any_of(file.trees.begin(), file.trees.end(), [&](const auto& tree) { return used.contains(tree.first); });
}

}  // namespace

TreeFiles treeFiles(const std::vector<std::string>& paths) {
  TreeFiles together;
  std::vector<FileOfTrees> files;
  std::set<std::string> seen, named, used;  // `used` by a file that has no such tree itself.
  for (const std::string& path : paths)
    if (seen.insert(fs::path(path).lexically_normal().generic_string()).second) files.push_back(fileOfTrees(path));
  for (const FileOfTrees& file : files) {
    named.insert(file.uses.begin(), file.uses.end());
    std::copy_if(file.uses.begin(), file.uses.end(), std::inserter(used, used.end()),
                 [&](const std::string& id) { return !file.trees.contains(id); });
    for (const auto& [id, location] : file.trees) together.trees[id].push_back(file.path);
  }
  std::map<std::string, Location> first;
  for (const FileOfTrees& file : files) {
    if (isUsed(file, used)) together.helpers.insert(file.path);
    for (const auto& [id, location] : file.trees) {
      const auto [known, is_new] = first.try_emplace(id, location);
      if (is_new || !named.contains(id)) continue;
      together.warnings.push_back({location, "BehaviorTree",
                                   Message("tree.defined-elsewhere",
                                           "`{}` is defined at {} too; a SubTree takes that of its own file, else of "
                                           "its folder, else the first",
                                           id, toString(known->second)),
                                   "give one of them another ID"});
    }
  }
  return together;
}

}  // namespace swiftlet::tree
