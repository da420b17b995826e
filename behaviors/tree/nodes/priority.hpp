// Priority: who stands higher has the vehicle first. Ours; BehaviorTree.CPP has no such node.
//
// At each tick the children are asked from the top; the first that has something to do (does not answer SKIPPED) has
// the vehicle:
//   child SKIPPED  -> the next is asked, in the same tick
//   child RUNNING  -> RUNNING
//   child SUCCESS  -> the next is asked, in the same tick; the last child: SUCCESS
//   child FAILURE  -> FAILURE (what is suspended below is dropped)
//   all SKIPPED    -> SKIPPED
// It ends with the status of its last child; when the last is SKIPPED after one above it ended with SUCCESS in the same
// tick, that is SUCCESS.
//
// A lower child that is under way when a higher one wants the vehicle is suspended, not reset. It is asked to let go
// once a tick; until it has, the Priority is RUNNING and the higher one is not ticked. If meanwhile nobody above wants
// the vehicle any more, the lower one goes on at once. After the higher one has ended, the lower one resumes where it
// was. Asking (Node::wants) changes nothing and starts nobody. Every switch is reported with its reason
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

  /// True when nobody below `index` has the vehicle.
  bool lowerHaveLetGo(TickContext& context, std::size_t index);
  /// `index` has the vehicle from now on; tells it when that is news.
  void give(TickContext& context, std::size_t index);
  void tell(TickContext& context, Switch::Kind kind, std::size_t to, std::string reason) const;

  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);
  std::size_t holder_ = kNobody;  ///< Has the vehicle, or had it last.
  std::size_t asker_ = kNobody;   ///< Waits for the holder to let go.
};

}  // namespace swiftlet::tree
