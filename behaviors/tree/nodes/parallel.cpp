#include "behaviors/tree/nodes/parallel.hpp"

#include "behaviors/tree/nodes/threshold.hpp"

namespace swiftlet::tree {

NodeManifest Parallel::manifest() {
  return {.id = "Parallel",
          .kind = NodeKind::kControl,
          .ports = {{.name = "success_count",
                     .type = PortType::kInt,
                     .default_value = "-1",
                     .minimum = -1000,
                     .maximum = 1000,
                     .description = "Number of children that must succeed; negative: counted from the end, -1 is all.",
                     .counts_children = true},
                    {.name = "failure_count",
                     .type = PortType::kInt,
                     .default_value = "1",
                     .minimum = -1000,
                     .maximum = 1000,
                     .description =
                         "Number of failures after which the node fails; negative: counted from the end, -1 is all.",
                     .counts_children = true}},
          .description = "All children in the same tick, until enough of them succeeded or failed."};
}

Parallel::Parallel(const NodeSetup& setup)
    : Composite(setup), success_count_(setup, "success_count"), failure_count_(setup, "failure_count") {}

std::optional<Message> Parallel::problemOfCounts() const {
  auto success = tooMany("success_count", success_count_.get(), count());
  return success ? success : tooMany("failure_count", failure_count_.get(), count());
}

void Parallel::clear(TickContext&) {
  ended_.assign(count(), false);
  successes_ = failures_ = 0;
}

Status Parallel::run(TickContext& context) {
  const auto success_count = success_count_.get();
  const auto failure_count = failure_count_.get();
  if (!success_count) return endWith(context, fail(context, success_count_.problem()));
  if (!failure_count) return endWith(context, fail(context, failure_count_.problem()));
  if (const auto problem = problemOfCounts()) return endWith(context, fail(context, problem->text()));
  const std::size_t needed = threshold(*success_count, count());
  const std::size_t bearable = threshold(*failure_count, count());

  std::size_t skipped = 0;
  for (std::size_t i = 0; i < count(); ++i) {
    if (!ended_[i]) {
      switch (child(i).tick(context)) {
        case Status::kSuccess:
          ended_[i] = true;
          ++successes_;
          break;
        case Status::kFailure:
          ended_[i] = true;
          ++failures_;
          break;
        case Status::kSkipped:
          ++skipped;
          break;
        case Status::kRunning:
        case Status::kIdle:
        case Status::kSuspended:
          break;
      }
    }
    if (skipped == i + 1) continue;  // There is no result yet: if all are SKIPPED, no count may decide.
    if (successes_ >= needed || (*success_count < 0 && successes_ + skipped >= needed))
      return endWith(context, Status::kSuccess);
    if (count() - failures_ < needed || failures_ == bearable) return endWith(context, Status::kFailure);
  }
  return skipped == count() ? Status::kSkipped : Status::kRunning;
}

}  // namespace swiftlet::tree
