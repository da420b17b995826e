// A built tree: the nodes, their blackboard entries and where each came from.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/node.hpp"
#include "behaviors/tree/node_record.hpp"
#include "behaviors/tree/problem.hpp"

namespace swiftlet::tree {

/// One node, for display.
struct NodeView {
  int id = 0;
  int parent = -1;  ///< -1 for the root.
  std::string name;
  Status status = Status::kIdle;
};

/// A bound port of a node, for display.
struct PortView {
  std::string name;
  std::string entry;                 ///< The entry that the port is bound to; empty for a literal or a script.
  std::optional<std::string> value;  ///< The literal, the text of the script, or the entry's value, if that is set.
};

struct TreeParts;

class Tree {
 public:
  /// Made by the parser.
  explicit Tree(std::unique_ptr<TreeParts> parts);
  Tree(Tree&&) noexcept;
  Tree& operator=(Tree&&) noexcept;
  ~Tree();

  Status tick(TickContext& context);
  /// Called each tick until it returns kReleased; the tree is then IDLE and may be ticked again.
  Release halt(TickContext& context);

  /// Sets an entry of the main tree that was named in ParseOptions::host_entries. False if it was not named, or if
  /// it has no reader.
  bool set(std::string_view entry, Value value);

  /// The ID of the main tree.
  const std::string& name() const;
  const Node& root() const;
  /// In preorder; the id of a node is its index.
  const std::vector<NodeRecord>& nodes() const;
  std::vector<NodeView> view() const;

  /// Also the `ID` of a SubTree, and scripted conditions.
  std::vector<PortView> portsOf(int id) const;
  /// Another number whenever an entry of its ports was written or has lost its value.
  std::uint64_t writesOfPorts(int id) const;

  /// "Main/Priority/Sequence[2]/Land": the names from the main tree down to a node. Siblings of one name are counted
  /// from 1.
  std::string pathOf(int id) const;
  /// The scripted conditions of a node; null without any.
  const Conditions* conditionsOf(int id) const;

  /// The position of a node's element, or of one of its attributes (of the element if the attribute is missing).
  Location locationOf(int id, std::string_view attribute = {}) const;
  /// The constant value of a script that reads no entry, by its attribute (`_skipIf`, `if`, `code`); else nullopt.
  std::optional<bool> constantTruth(int id, std::string_view attribute) const;

  /// Every value that a port may take before the first tick: its literal or default, or the texts that subtree ports
  /// and SetBlackboard give its entry. Values that cannot be parsed are left out, because they are problems already.
  std::vector<Value> knownValues(int id, std::string_view port) const;
  /// Whether the port can take no other value: no node and no script computes one.
  bool knowsEveryValue(int id, std::string_view port) const;

 private:
  std::unique_ptr<TreeParts> parts_;
};

}  // namespace swiftlet::tree
