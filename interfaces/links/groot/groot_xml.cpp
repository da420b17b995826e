#include "interfaces/links/groot/groot_xml.hpp"

#include "common/markup.hpp"

namespace swiftlet::interfaces {
namespace {

constexpr const char* kMain = "Main";

class GrootWriter {
 public:
  explicit GrootWriter(const common::TreeView& tree)
      : tree_(tree), blackboards_(grootBlackboards(tree)), children_(tree.size()) {
    for (std::size_t i = 0; i < tree.size(); ++i)
      if (tree[i].parent >= 0) children_[static_cast<std::size_t>(tree[i].parent)].push_back(i);
  }

  std::string write(const std::string& models) {
    text_ = "<root BTCPP_format=\"4\" main_tree_to_execute=\"" + std::string(kMain) + "\">\n";
    if (!tree_.empty()) writeTree(kMain, {}, 0);
    for (std::size_t i = 0; i < tree_.size(); ++i)
      if (isSubTree(i) && !children_[i].empty())
        writeTree(tree_[i].name, blackboards_[children_[i].front()], children_[i].front());
    return text_ + models + "</root>\n";
  }

 private:
  bool isSubTree(std::size_t node) const { return tree_[node].type == "SubTree"; }

  void writeTree(const std::string& id, const std::string& path, std::size_t root) {
    text_ += "<BehaviorTree ID=\"" + common::escaped(id) + "\" _fullpath=\"" + common::escaped(path) + "\">\n";
    writeNode(root);
    text_ += "</BehaviorTree>\n";
  }

  /// The depth is bounded by the reader of the mission.
  void writeNode(std::size_t node) {
    const common::TreeNodeView& view = tree_[node];
    const std::string uid = " _uid=\"" + std::to_string(node + 1) + "\"";
    if (isSubTree(node)) {
      const std::string path = children_[node].empty() ? "" : blackboards_[children_[node].front()];
      text_ += "<SubTree ID=\"" + common::escaped(view.name) + "\" _fullpath=\"" + common::escaped(path) + "\"" + uid +
               "/>\n";
      return;
    }
    text_ += "<" + view.type + " name=\"" + common::escaped(view.name) + "\"" + uid;
    for (const common::TreePortView& port : view.ports)
      text_ += " " + port.name + "=\"" +
               common::escaped(port.entry.empty() ? port.value.value_or("") : "{" + port.entry + "}") + "\"";
    if (children_[node].empty()) {
      text_ += "/>\n";
      return;
    }
    text_ += ">\n";
    for (const std::size_t child : children_[node]) writeNode(child);
    text_ += "</" + view.type + ">\n";
  }

  const common::TreeView& tree_;
  std::vector<std::string> blackboards_;
  std::vector<std::vector<std::size_t>> children_;
  std::string text_;
};

}  // namespace

std::string grootXml(const common::TreeView& tree, const std::string& models) {
  return GrootWriter(tree).write(models);
}

std::vector<std::string> grootBlackboards(const common::TreeView& tree) {
  std::vector<std::string> names;
  for (const common::TreeNodeView& node : tree) {
    if (node.parent < 0) {
      names.emplace_back(kMain);
      continue;
    }
    const auto parent = static_cast<std::size_t>(node.parent);
    if (tree[parent].type != "SubTree") {
      names.push_back(names[parent]);
      continue;
    }
    const std::string outer = names[parent] == kMain ? "" : names[parent] + "/";
    names.push_back(outer + tree[parent].name + "::" + std::to_string(tree[parent].id + 1));
  }
  return names;
}

}  // namespace swiftlet::interfaces
