// LoopDouble, LoopInt, LoopBool, LoopString: run the child once for each element of a queue "1;2;3".
//   no element left            -> the status if_empty
//   child SUCCESS or SKIPPED   -> RUNNING; the next element at the next tick
//   child RUNNING              -> RUNNING
//   child FAILURE              -> FAILURE
// The queue of an entry is shared: each element is taken out of the entry. One that is written in the file starts anew
// with the node.
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class Loop final : public Composite {
 public:
  Loop(const NodeSetup& setup, PortType element);
  static NodeManifest manifest(std::string id, PortType element);
  std::string checkBuilt() const override;

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override;
  bool onAsked(const TickContext& context) const override;
  /// The text of the elements that are left; null if the entry is not set, or is no text.
  const std::string* left() const;
  /// Takes the first element out. False, with a reason, if it is not of the type.
  bool takeNext(TickContext& context, const std::string& queue);

  PortType element_;
  PortBinding queue_;
  std::string own_;  ///< What is left of a queue that is written in the file.
  Input<std::string> if_empty_;
  Output value_;
};

}  // namespace swiftlet::tree
