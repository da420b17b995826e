#include "behaviors/tree/nodes/try_catch.hpp"

namespace swiftlet::tree {

NodeManifest TryCatch::manifest() {
  return {.id = "TryCatch",
          .kind = NodeKind::kControl,
          .ports = {{.name = "catch_on_halt",
                     .type = PortType::kBool,
                     .default_value = "false",
                     .description = "Whether the last child is ticked once also when the others are halted."}},
          .description = "The children but the last one after the other; when one fails, the last one, then FAILURE.",
          .least_children = 2};
}

void TryCatch::clear(TickContext&) {
  current_ = skipped_ = 0;
  caught_ = false;
}

bool TryCatch::onAsked(const TickContext& context) const {
  for (std::size_t i = 0; i < tried(); ++i)
    if (child(i).wants(context)) return true;
  return false;
}

Status TryCatch::run(TickContext& context) {
  for (; !caught_ && current_ < tried(); ++current_) {
    const Status status = child(current_).tick(context);
    if (status == Status::kRunning) return Status::kRunning;
    caught_ = status == Status::kFailure;
    if (caught_) break;
    skipped_ += status == Status::kSkipped ? 1 : 0;
  }
  if (!caught_) return skipped_ == tried() ? Status::kSkipped : Status::kSuccess;
  return child(tried()).tick(context) == Status::kRunning ? Status::kRunning : Status::kFailure;
}

Release TryCatch::onHalt(TickContext& context) {
  if (Composite::onHalt(context) == Release::kLettingGo) return Release::kLettingGo;
  if (caught_ || !catch_on_halt_.get().value_or(false)) return Release::kReleased;
  caught_ = true;
  return child(tried()).tick(context) == Status::kRunning ? Composite::onHalt(context) : Release::kReleased;
}

}  // namespace swiftlet::tree
