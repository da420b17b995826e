#include "behaviors/tree/nodes/while_do_else.hpp"

#include "behaviors/tree/nodes/ended_as.hpp"

namespace swiftlet::tree {

NodeManifest WhileDoElse::manifest() {
  return {.id = "WhileDoElse",
          .kind = NodeKind::kControl,
          .ports = {},
          .description = "The second child while the first succeeds, else the third; asks the first at every tick.",
          .least_children = 2,
          .most_children = 3};
}

Status WhileDoElse::run(TickContext& context) {
  // A halted child is released before anything else is asked.
  if (chosen_ == 0 && !haltOthers(context, 0)) return Status::kRunning;
  const Status condition = child().tick(context);
  if (condition == Status::kRunning) return Status::kRunning;
  if (condition == Status::kSkipped) return endWith(context, Status::kSkipped);
  if (condition == Status::kFailure && count() == 2) return endWith(context, Status::kFailure);
  const std::size_t wanted = condition == Status::kSuccess ? 1 : 2;
  const bool changes = chosen_ != wanted;
  chosen_ = wanted;
  if (changes && !haltOthers(context, wanted)) {
    chosen_ = 0;
    return Status::kRunning;
  }
  return skippedAsSuccess(child(wanted).tick(context));
}

}  // namespace swiftlet::tree
