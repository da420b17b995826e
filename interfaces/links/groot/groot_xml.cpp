#include "interfaces/links/groot/groot_xml.hpp"

#include <algorithm>
#include <string_view>

#include "common/markup.hpp"

namespace swiftlet::interfaces {
namespace {

const std::string* portOf(const common::TreeNodeView& node, std::string_view name) {
  for (const common::TreePortView& port : node.ports)
    if (port.name == name && port.value) return &*port.value;
  return nullptr;
}

/// The ID of the tree that a SubTree uses.
const std::string& treeOf(const common::TreeNodeView& subtree) {
  const std::string* id = portOf(subtree, "ID");
  return id == nullptr ? subtree.name : *id;
}

/// The ID that the main tree is shown with: its own, or one that no other tree has.
std::string mainOf(const std::string& name, const common::TreeView& tree) {
  std::string id = name.empty() ? "Main" : name;
  const auto isOfSubTree = [&](const common::TreeNodeView& node) {
    return node.type == "SubTree" && treeOf(node) == id;
  };
  while (std::any_of(tree.begin(), tree.end(), isOfSubTree)) id += "_";
  return id;
}

class GrootWriter {
 public:
  GrootWriter(const std::string& name, const common::TreeView& tree)
      : tree_(tree), main_(mainOf(name, tree)), blackboards_(grootBlackboards(name, tree)), children_(tree.size()) {
    for (std::size_t i = 0; i < tree.size(); ++i)
      if (tree[i].parent >= 0) children_[static_cast<std::size_t>(tree[i].parent)].push_back(i);
  }

  std::string write(const std::string& models) {
    text_ = "<root BTCPP_format=\"4\" main_tree_to_execute=\"" + common::escaped(main_) + "\">\n";
    if (!tree_.empty()) writeTree(main_, {}, 0);
    for (std::size_t i = 0; i < tree_.size(); ++i)
      if (isSubTree(i) && !children_[i].empty())
        writeTree(treeOf(tree_[i]), blackboards_[children_[i].front()], children_[i].front());
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
      text_ += "<SubTree ID=\"" + common::escaped(treeOf(view)) + "\" _fullpath=\"" + common::escaped(path) + "\"";
      if (view.name != treeOf(view)) text_ += " name=\"" + common::escaped(view.name) + "\"";
      text_ += uid;
      writePorts(view);
      text_ += "/>\n";
      return;
    }
    text_ += "<" + view.type + " name=\"" + common::escaped(view.name) + "\"" + uid;
    writePorts(view);
    if (children_[node].empty()) {
      text_ += "/>\n";
      return;
    }
    text_ += ">\n";
    for (const std::size_t child : children_[node]) writeNode(child);
    text_ += "</" + view.type + ">\n";
  }

  void writePorts(const common::TreeNodeView& view) {
    for (const common::TreePortView& port : view.ports)
      if (!isSubTree(static_cast<std::size_t>(view.id)) || port.name != "ID")
        text_ += " " + port.name + "=\"" +
                 common::escaped(port.entry.empty() ? port.value.value_or("") : "{" + port.entry + "}") + "\"";
  }

  const common::TreeView& tree_;
  std::string main_;
  std::vector<std::string> blackboards_;
  std::vector<std::vector<std::size_t>> children_;
  std::string text_;
};

}  // namespace

std::string grootXml(const std::string& name, const common::TreeView& tree, const std::string& models) {
  return GrootWriter(name, tree).write(models);
}

std::vector<std::string> grootBlackboards(const std::string& name, const common::TreeView& tree) {
  std::vector<std::string> names;
  const std::string main = mainOf(name, tree);
  for (const common::TreeNodeView& node : tree) {
    if (node.parent < 0) {
      names.push_back(main);
      continue;
    }
    const auto parent = static_cast<std::size_t>(node.parent);
    if (tree[parent].type != "SubTree") {
      names.push_back(names[parent]);
      continue;
    }
    const std::string outer = names[parent] == main ? "" : names[parent] + "/";
    names.push_back(outer + tree[parent].name + "::" + std::to_string(tree[parent].id + 1));
  }
  return names;
}

}  // namespace swiftlet::interfaces
