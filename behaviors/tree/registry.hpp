// The node types an XML file may use.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/node.hpp"
#include "behaviors/tree/port.hpp"

namespace swiftlet::tree {

enum class NodeKind : unsigned char { kAction, kCondition, kControl, kDecorator };
/// "Action", "Condition", "Control", "Decorator": the tags of the explicit form.
const char* toString(NodeKind kind);

struct NodeManifest {
  std::string id = {};
  NodeKind kind = NodeKind::kAction;
  std::vector<PortManifest> ports = {};
  std::string description = {};  ///< One sentence.
  /// Whether it may answer SKIPPED by itself (leaves), or only as its children do.
  bool may_skip = false;

  const PortManifest* findPort(std::string_view name) const;
  /// Controls: 1 or more; decorators: 1; leaves: 0.
  int minChildren() const { return kind == NodeKind::kControl || kind == NodeKind::kDecorator ? 1 : 0; }
  int maxChildren() const {
    return kind == NodeKind::kControl ? std::numeric_limits<int>::max() : kind == NodeKind::kDecorator ? 1 : 0;
  }
};

/// Kinds with children build a Composite, the others a Leaf.
using NodeBuilder = std::function<std::unique_ptr<Node>(const NodeSetup&)>;

struct NodeType {
  NodeManifest manifest;
  NodeBuilder build;
};

/// Must outlive the trees built from it.
class Registry {
 public:
  /// The control nodes, decorators and leaves of the engine.
  static Registry standard();

  /// Replaces a type of the same id.
  void add(NodeManifest manifest, NodeBuilder build);
  /// A class with `static NodeManifest manifest()` and a constructor from NodeSetup.
  template <typename T>
  void add() {
    add(T::manifest(), [](const NodeSetup& setup) { return std::make_unique<T>(setup); });
  }

  const NodeType* find(std::string_view id) const;
  const std::map<std::string, NodeType, std::less<>>& types() const { return types_; }
  std::vector<std::string> ids() const;

 private:
  std::map<std::string, NodeType, std::less<>> types_;
};

/// The palette an editor (Groot2) loads: <root><TreeNodesModel> with every type of the registry that is not its own.
std::string writeTreeNodesModel(const Registry& registry);
/// An XML Schema 1.0 of tree files for this registry: elements, ports, types, ranges and numbers of children.
std::string writeSchema(const Registry& registry);

}  // namespace swiftlet::tree
