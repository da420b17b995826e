// The parts of a Tree. For use inside the engine only.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "behaviors/tree/conditions.hpp"
#include "behaviors/tree/document.hpp"
#include "behaviors/tree/node_record.hpp"
#include "behaviors/tree/problem.hpp"
#include "behaviors/tree/script/script.hpp"

namespace swiftlet::tree {

/// The position of a node: a file and an offset in it, and its id in the tree.
struct NodeOrigin {
  const Document* document = nullptr;
  std::size_t offset = 0;
  int node = -1;
};

/// A place that gives an entry a text.
struct LiteralWrite {
  std::string text;
  NodeOrigin origin;
  std::string attribute;
  bool is_text = false;  ///< Scripts compare and join it as a text, whatever it looks like.
};

/// A port that reads an entry.
struct EntryRead {
  const PortManifest* port = nullptr;
  std::string owner;  ///< The node's type.
  NodeOrigin origin;
};

/// A comparison or a sum in a script.
struct PairedOperands {
  const Script* script = nullptr;
  ScriptPairing pairing;
  EntryRead read;  ///< Where the script stands.
};

/// All sources and readers of one entry, as far as the file shows them; each source once.
struct EntryFlow {
  std::vector<LiteralWrite> literals;    ///< Each text from the first place that gives it.
  std::vector<EntryRead> reads;          ///< One for each port manifest.
  std::vector<std::size_t> copied_from;  ///< Slots whose value SetBlackboard copies here.
  std::vector<PortType> typed_writes;    ///< Types that output ports of leaves write.
  bool is_set = false;                   ///< One of these sources makes the entry; others only change it.
  bool is_unset = false;                 ///< A node takes its value away.
  bool by_host = false;
};

struct TreeParts {
  explicit TreeParts(const Constants& constants) : scripts(constants) {}

  std::string name;
  std::unique_ptr<Node> root;
  std::vector<NodeRecord> records;
  std::vector<NodeSetup> setups;                     ///< By node id.
  std::vector<NodeOrigin> origins;                   ///< By node id.
  std::map<int, std::string> subtree_ids;            ///< Of the SubTrees, by node id: the tree that each uses.
  std::vector<std::unique_ptr<Document>> documents;  ///< From which the tree was made; scripts are read in their text.
  Scripts scripts;
  std::deque<Conditions> conditions;  ///< Stable addresses.
  std::deque<Slot> slots;             ///< Stable addresses.
  std::deque<EntryFlow> flows;        ///< By slot id.
  std::vector<PairedOperands> pairings;

  Location locate(const NodeOrigin& origin, std::string_view attribute = {}) const;
  /// As Tree::pathOf. The tree must be complete.
  std::string pathOf(int id) const;
  /// The slot and those it is copied from, directly or not, at most kMaxCopies of them. What may reach the slot as text
  /// are their literals.
  std::vector<std::size_t> sourcesOf(std::size_t slot) const;
  static constexpr std::size_t kMaxCopies = 64;
  /// Whether these literals are all that may reach it.
  bool isOnlyWrittenAsText(std::size_t slot) const;
  /// What a port makes of these literals; those that it cannot take are left out.
  const std::vector<Value>& valuesOf(std::size_t slot, const PortManifest& port) const;

 private:
  int numberAmongSiblings(int id) const;

  // Each is made when it is asked for the first time.
  mutable std::map<std::pair<std::size_t, const PortManifest*>, std::vector<Value>> values_;
  mutable std::vector<int> numbers_;  ///< By node id: counted from 1 among siblings of one name; 0 for the only one.
};

}  // namespace swiftlet::tree
