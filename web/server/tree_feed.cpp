#include "web/server/tree_feed.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "web/server/tree_json.hpp"

namespace swiftlet::web {
namespace {

bool isSameNode(const common::TreeNodeView& a, const common::TreeNodeView& b) {
  return a.parent == b.parent && a.name == b.name && a.type == b.type;
}

}  // namespace

void TreeFeed::update(const common::TreeView& tree) {
  if (!std::equal(tree.begin(), tree.end(), tree_.begin(), tree_.end(), isSameNode)) {
    whole_ = ++version_;
    tree_ = tree;
    changed_.assign(tree.size(), version_);
    return;
  }
  bool changed = false;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (tree[i] == tree_[i]) continue;
    tree_[i] = tree[i];
    changed_[i] = version_ + 1;
    changed = true;
  }
  version_ += changed ? 1 : 0;
}

std::string TreeFeed::since(std::uint64_t version) const {
  if (version == version_) return {};
  const bool whole = version < whole_;
  auto nodes = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < tree_.size(); ++i)
    if (changed_[i] > version) nodes.push_back(nodeJson(tree_[i], whole));
  const nlohmann::ordered_json message = {{"type", "tree"}, {"whole", whole}, {"nodes", nodes}};
  return message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace swiftlet::web
