// The requests of Groot2 to a running tree, and the answers: its monitor protocol, version 2, without the socket.
//
//   request   u8 protocol = 2, u8 type, u32 id (little endian); then, for some types, a second part
//   reply     the six bytes of the request, 16 bytes that identify the tree; then a second part
//
//   T  the tree as XML, each node with its _uid            S  u16 uid, u8 status for each node
//   B  names of blackboards with `;` between -> msgpack    r  "start" recording -> microseconds of the start; or "stop"
//   D  breakpoints, always empty                           t  u48 microseconds since the start, u16 uid, u8 status for
//                                                             each change since it was asked last
//   A, X  remove or disable all breakpoints: there are none
//
// Status: IDLE 0, RUNNING 1, SUCCESS 2, FAILURE 3, SKIPPED 4; 10 + status for IDLE after it. SUSPENDED, which Groot2
// does not have, is shown as IDLE after RUNNING. A request for a breakpoint is refused: nothing but the mission and the
// operator may stop a flight. Facts of the protocol: BehaviorTree.CPP, groot2_protocol.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/time.hpp"
#include "common/world/tree_view.hpp"

namespace swiftlet::interfaces {

class GrootMonitor {
 public:
  /// `models`: the <TreeNodesModel> element with the types that Groot2 does not know; may be empty.
  explicit GrootMonitor(std::string models) : models_(std::move(models)) {}

  /// The tree as of `stamp`; `name` is the ID of its main tree. A tree of another name or other nodes is another tree,
  /// with another identity.
  void update(const std::string& name, const common::TreeView& tree, common::Time stamp);

  /// The parts of the reply. A request that cannot be answered gets "error" and the reason.
  std::vector<std::string> answer(const std::vector<std::string>& request);

 private:
  void replaceTree(const common::TreeView& tree);
  void changeStatus(std::size_t node, const common::TreeNodeView& next, common::Time stamp);
  std::string statusBytes() const;
  std::string blackboards(const std::string& names) const;
  void record(bool on);

  std::string models_;
  std::string name_;
  common::TreeView tree_;
  std::vector<std::uint8_t> statuses_;  ///< By node, as Groot2 numbers them.
  std::string xml_;
  std::string identity_ = std::string(16, '\0');
  common::Time stamp_;
  bool recording_ = false;
  common::Time recording_since_;
  std::string transitions_;
};

}  // namespace swiftlet::interfaces
