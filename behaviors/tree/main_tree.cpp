// Which of the trees of a file is its main one.
#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "behaviors/tree/document_problems.hpp"
#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/elements.hpp"

namespace swiftlet::tree {

Documents::Mains Documents::likelyMains(const Document& main_file) const {
  std::set<std::string> used;
  for (const auto& document : documents)
    for (std::string& id : subTreesOf(document->root)) used.insert(std::move(id));
  using Rank = std::tuple<bool, bool, std::string, std::size_t>;
  std::map<Rank, std::string> ranked;
  for (const auto& [id, tree] : trees)
    if (const Document& file = *tree.document; !file.is_elsewhere)
      ranked[{used.contains(id), &file != &main_file, file.source.file(), tree.element->offset}] = id;
  Mains mains;
  for (const auto& [rank, id] : ranked) {
    mains.ids.push_back(id);
    mains.unused += std::get<0>(rank) ? 0 : 1;
  }
  return mains;
}

std::string Documents::Mains::hint() const {
  if (ids.empty()) return {};
  std::string text = fmt::format("write main_tree_to_execute=\"{}\"", ids.front());
  if (unused == 1) text += " for the only tree that no other one uses";
  if (unused < 2) return text;
  constexpr std::size_t kMost = 4;
  const std::span others = std::span(ids).first(std::min(unused, kMost)).subspan(1);
  return text + ", or another that no tree uses: " + quotedList(others);
}

void Documents::findMain(const Document& main_file) {
  const XmlElement& root = main_file.root;
  const Mains mains = likelyMains(main_file);
  const std::string* wanted = root.attribute("main_tree_to_execute");
  if (wanted != nullptr && wanted->empty()) wanted = nullptr;
  if ((wanted == nullptr ? mains.ids.empty() : !trees.contains(*wanted)) && lost_a_tree_) return;
  if (wanted == nullptr && mains.ids.empty()) {
    problems_.add({main_file.at(root), "root", Message("tree.no-tree", "there is no <BehaviorTree>")});
    return;
  }
  if (wanted == nullptr && mains.ids.size() > 1) {
    reportForeign(
        {main_file.at(root), "root",
         Message("tree.main-missing", "main_tree_to_execute is missing, expected where there are several trees"),
         mains.hint()});
    if (!options_.lenient) return;
  }
  main_id = wanted == nullptr ? mains.ids.front() : *wanted;
  const std::string near = didYouMean(main_id, mains.ids);
  if (const auto found = trees.find(main_id); found != trees.end())
    main = &found->second;
  else
    problems_.add(unknownTree(main_file, root, "main_tree_to_execute", near.empty() ? mains.hint() : near));
}

}  // namespace swiftlet::tree
