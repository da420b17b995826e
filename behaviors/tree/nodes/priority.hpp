// Priority: the highest child that does not answer SKIPPED is in control. BehaviorTree.CPP has no such node.
//
// At each tick the children are asked from the top; the first that does not answer SKIPPED is in control:
//   child SKIPPED  -> the next is asked, in the same tick
//   child RUNNING  -> RUNNING
//   child SUCCESS  -> the next is asked, in the same tick; the last child: SUCCESS
//   child FAILURE  -> FAILURE (what is suspended below is dropped)
//   all SKIPPED    -> SKIPPED
// It ends with the status of its last child. If the last child is SKIPPED after one above it ended with SUCCESS in the
// same tick, the result is SUCCESS.
//
// A lower child that is running when a higher one would start is suspended, not reset: it is called once a tick until
// it is released. Until then the Priority is RUNNING and ticks no higher one. If the higher one would be SKIPPED
// meanwhile, the lower one continues at once. After the higher one has ended, the lower one resumes where it
// was. Asking (Node::wants) changes nothing and starts no node. Every switch is reported with its reason
// (Observer::onSwitch).
#pragma once

#include "behaviors/tree/composite.hpp"
#include "behaviors/tree/node_manifest.hpp"

namespace swiftlet::tree {

class Priority final : public Composite {
 public:
  using Composite::Composite;
  static NodeManifest manifest();

 private:
  Status run(TickContext& context) override;
  void clear(TickContext&) override;

  /// True if every child below `index` is released.
  bool lowerHaveLetGo(TickContext& context, std::size_t index);
  /// Gives `index` control from now on; reports the switch if it is one.
  void give(TickContext& context, std::size_t index);
  void report(TickContext& context, Switch::Kind kind, std::size_t to, std::string reason) const;

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t holder_ = kNone;  ///< The child in control, or the last one that was.
  std::size_t asker_ = kNone;   ///< Waits for the release of the holder.
};

}  // namespace swiftlet::tree
