// Records the sources and the readers of each entry, while a tree is built.
#pragma once

#include <cstddef>
#include <deque>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/tree_parts.hpp"

namespace swiftlet::tree {

class FlowRecorder {
 public:
  /// The flows by slot id.
  FlowRecorder(std::deque<EntryFlow>& flows, std::vector<PairedOperands>& pairings)
      : flows_(flows), pairings_(pairings) {}

  /// What the ports of a node that are bound to entries read and write.
  void recordPorts(const NodeOrigin& origin, const NodeManifest& manifest, const NodeSetup& setup);
  /// `script` is bound to its slots; `owner` is the type of the node, `port` where the script stands.
  void recordScript(const Script& script, const NodeOrigin& origin, const std::string& owner, const PortManifest& port);
  void recordLiteral(std::size_t slot, LiteralWrite literal);

 private:
  void recordRead(std::size_t slot, const NodeOrigin& origin, const std::string& owner, const PortManifest& port);
  void recordOutput(const NodeOrigin& origin, const NodeSetup& setup, const PortBinding& output);
  bool recordElements(const NodeOrigin& origin, const PortBinding& queue, const PortBinding& output);
  void recordCopy(std::size_t slot, std::size_t from);
  void recordType(std::size_t slot, PortType type);

  std::deque<EntryFlow>& flows_;
  std::vector<PairedOperands>& pairings_;
  std::set<std::tuple<std::size_t, bool, std::string>> literals_;  ///< The texts of each slot.
  std::set<std::pair<std::size_t, std::size_t>> copies_;           ///< The sources of each slot.
};

}  // namespace swiftlet::tree
