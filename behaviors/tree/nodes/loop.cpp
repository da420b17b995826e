#include "behaviors/tree/nodes/loop.hpp"

#include <utility>

namespace swiftlet::tree {

NodeManifest Loop::manifest(std::string id, PortType element) {
  return {.id = std::move(id),
          .kind = NodeKind::kDecorator,
          .ports = {{.name = "queue",
                     .required = true,
                     .description = "The elements, or the entry that holds them; read when the node starts.",
                     .elements = element},
                    {.name = "if_empty",
                     .default_value = "SUCCESS",
                     .description = "The status when no element is left.",
                     .names_status = true},
                    {.name = "value",
                     .type = element,
                     .direction = Direction::kOutput,
                     .description = "The entry that gets the element.",
                     .element_of = "queue"}},
          .description = "The child once for each element of a queue."};
}

Loop::Loop(const NodeSetup& setup, PortType element)
    : Composite(setup),
      element_(element),
      queue_(setup, "queue"),
      if_empty_(setup, "if_empty"),
      value_(setup, "value") {}

void Loop::clear(TickContext&) { left_.reset(); }

bool Loop::onAsked(const TickContext&) const {
  const auto queue = queue_.get();
  const auto text = if_empty_.get();
  return !queue || !queue->empty() || !text || *text != "SKIPPED";
}

Status Loop::run(TickContext& context) {
  if (!left_) left_ = queue_.get();
  if (!left_) return fail(context, queue_.problem());
  if (!isActive(child().status())) {
    if (left_->empty()) {
      const auto status = answerFrom(if_empty_.get().value_or(""));
      return status ? *status : fail(context, if_empty_.problem());
    }
    if (!takeNext(context)) return Status::kFailure;
  }
  return child().tick(context) == Status::kFailure ? Status::kFailure : Status::kRunning;
}

bool Loop::takeNext(TickContext& context) {
  const std::size_t end = left_->find(';');
  const std::string first = left_->substr(0, end);
  left_->erase(0, end == std::string::npos ? end : end + 1);
  auto value = parseValue(first, element_, {});
  if (!value) {
    (void)fail(context, "the element `" + first + "` is not a " + toString(element_));
    return false;
  }
  value_.set(std::move(*value));
  return true;
}

}  // namespace swiftlet::tree
