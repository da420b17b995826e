// The node types an XML file may use.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "behaviors/tree/node.hpp"
#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/script/program.hpp"

namespace swiftlet::tree {

/// Kinds with children make a Composite, the others a Leaf.
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

  /// Replaces a type with the same id. Scripts may name the choices of its ports, in capitals, for their numbers:
  /// `mode := far ? BRISK : CAREFUL`.
  void add(NodeManifest manifest, NodeBuilder build);
  /// A class with `static NodeManifest manifest()` and a constructor from NodeSetup.
  template <typename T>
  void add() {
    add(T::manifest(), [](const NodeSetup& setup) { return std::make_unique<T>(setup); });
  }

  /// A name that scripts may use for a number, as an enumerator of a port.
  void addConstant(std::string name, std::int64_t value) { constants_.insert_or_assign(std::move(name), value); }
  const Constants& constants() const { return constants_; }

  const NodeType* find(std::string_view id) const;
  const std::map<std::string, NodeType, std::less<>>& types() const { return types_; }
  std::vector<std::string> ids() const;

 private:
  std::map<std::string, NodeType, std::less<>> types_;
  Constants constants_;
};

/// The name by which scripts know the number of that choice.
std::string constantOf(std::string choice);

/// The palette that an editor (Groot2) loads: <root><TreeNodesModel> with every type of the registry that the editor
/// does not have itself.
std::string writeTreeNodesModel(const Registry& registry);
/// An XML Schema 1.0 of tree files for this registry: elements, ports, types, ranges and numbers of children.
std::string writeSchema(const Registry& registry);
/// A Markdown table of every type: kind, sentence, and its ports with bounds and defaults.
std::string writeNodeTable(const Registry& registry);
/// What <SubTree> is, for documents: it is an element of the format and no type of the registry.
const NodeManifest& subTreeManifest();
/// A line for each type, and for SubTree: its name and its sentence.
std::string writeNodeList(const Registry& registry);
/// A type in plain text: its sentence, and each port with bounds, default and what it means.
std::string writeNodeHelp(const NodeManifest& manifest);

}  // namespace swiftlet::tree
