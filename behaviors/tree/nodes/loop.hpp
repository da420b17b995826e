// LoopDouble, LoopInt, LoopBool, LoopString: run the child once for each element of a queue "1;2;3".
//   no element left            -> the status if_empty
//   child SUCCESS or SKIPPED   -> RUNNING; the next element at the next tick
//   child RUNNING              -> RUNNING
//   child FAILURE              -> FAILURE
// The queue is read when the node starts: what is written to its entry afterwards counts from the next start on. An
// entry that holds a number is a queue of that element.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class Loop final : public Composite {
 public:
  Loop(const NodeSetup& setup, PortType element);
  static NodeManifest manifest(std::string id, PortType element);

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override;
  bool onAsked(const TickContext& context) const override;
  /// Takes the first element out. False, with a reason, if it is not of the type.
  bool takeNext(TickContext& context);

  PortType element_;
  Input<std::string> queue_;
  std::optional<std::string> left_;  ///< The elements that are left; nothing before the queue was read.
  Input<std::string> if_empty_;
  Output value_;
};

}  // namespace swiftlet::tree
