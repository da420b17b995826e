#include "behaviors/tree/nodes/retry_until_successful.hpp"

namespace swiftlet::tree {

NodeManifest RetryUntilSuccessful::manifest() {
  return {.id = "RetryUntilSuccessful",
          .kind = NodeKind::kDecorator,
          .ports = {{.name = "num_attempts",
                     .type = PortType::kInt,
                     .required = true,
                     .minimum = -1,
                     .description = "So many attempts in all; -1: for ever."}},
          .description = "The child again after each failure, until it succeeds."};
}

RetryUntilSuccessful::RetryUntilSuccessful(const NodeSetup& setup)
    : Composite(setup), num_attempts_(setup, "num_attempts") {}

bool RetryUntilSuccessful::onAsked(const TickContext& context) const {
  const auto attempts = num_attempts_.get();
  return !attempts || *attempts == 0 || Composite::onAsked(context);
}

Status RetryUntilSuccessful::run(TickContext& context) {
  const auto attempts = num_attempts_.get();
  if (!attempts) return endWith(context, fail(context, num_attempts_.problem()));

  while (*attempts == -1 || done_ < *attempts) {
    const bool starts_now = !isActive(child().status());
    switch (const Status status = child().tick(context)) {
      case Status::kFailure:
        ++done_;
        if (starts_now && (*attempts == -1 || done_ < *attempts)) return Status::kRunning;
        break;
      case Status::kRunning:
      case Status::kSuccess:
      case Status::kSkipped:
      case Status::kIdle:
      case Status::kSuspended:
        return status;
    }
  }
  return endWith(context, Status::kFailure);
}

}  // namespace swiftlet::tree
