#include "behaviors/tree/nodes/parallel_all.hpp"

#include "behaviors/tree/nodes/threshold.hpp"

namespace swiftlet::tree {

NodeManifest ParallelAll::manifest() {
  return {.id = "ParallelAll",
          .kind = NodeKind::kControl,
          .ports = {{.name = "max_failures",
                     .type = PortType::kInt,
                     .default_value = "1",
                     .minimum = -1000,
                     .maximum = 1000,
                     .description =
                         "Number of failures after which the node fails; negative: counted from the end, -1 is all.",
                     .counts_children = true}},
          .description = "All children in the same tick, until each of them has ended."};
}

ParallelAll::ParallelAll(const NodeSetup& setup) : Composite(setup), max_failures_(setup, "max_failures") {}

void ParallelAll::clear(TickContext&) {
  ended_.assign(count(), false);
  failures_ = 0;
}

Status ParallelAll::run(TickContext& context) {
  const auto max_failures = max_failures_.get();
  if (!max_failures) return endWith(context, fail(context, max_failures_.problem()));
  std::size_t skipped = 0, running = 0;
  for (std::size_t i = 0; i < count(); ++i) {
    if (ended_[i]) continue;
    const Status status = child(i).tick(context);
    skipped += status == Status::kSkipped ? 1 : 0;
    running += status == Status::kRunning ? 1 : 0;
    failures_ += status == Status::kFailure ? 1 : 0;
    ended_[i] = status == Status::kFailure || status == Status::kSuccess;
  }
  if (skipped == count()) return Status::kSkipped;
  if (running > 0) return Status::kRunning;
  return failures_ >= threshold(*max_failures, count()) ? Status::kFailure : Status::kSuccess;
}

}  // namespace swiftlet::tree
