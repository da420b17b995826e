#include "behaviors/tree/nodes/run_once.hpp"

namespace swiftlet::tree {

NodeManifest RunOnce::manifest() {
  return {
      .id = "RunOnce",
      .kind = NodeKind::kDecorator,
      .ports = {{.name = "then_skip",
                 .type = PortType::kBool,
                 .default_value = "true",
                 .description = "Whether the node is SKIPPED after its child has ended, or keeps the child's status."}},
      .description = "The child until it has ended once, and never again."};
}

bool RunOnce::onAsked(const TickContext& context) const {
  const auto then_skip = then_skip_.get();
  return !then_skip || (ended_ ? !*then_skip : Composite::onAsked(context));
}

Status RunOnce::run(TickContext& context) {
  const auto then_skip = then_skip_.get();
  if (!then_skip) return endWith(context, fail(context, then_skip_.problem()));
  if (ended_) return *then_skip ? Status::kSkipped : *ended_;
  const Status status = child().tick(context);
  if (status == Status::kSuccess || status == Status::kFailure) ended_ = status;
  return status;
}

}  // namespace swiftlet::tree
