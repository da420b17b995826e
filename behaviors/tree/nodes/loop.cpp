#include "behaviors/tree/nodes/loop.hpp"

#include <utility>

namespace swiftlet::tree {

NodeManifest Loop::manifest(std::string id, PortType element) {
  return {.id = std::move(id),
          .kind = NodeKind::kDecorator,
          .ports = {{.name = "queue",
                     .direction = Direction::kInOut,
                     .required = true,
                     .description = "The elements with `;` between, or the entry that holds them."},
                    {.name = "if_empty",
                     .default_value = "SUCCESS",
                     .description = "The status when no element is left: SUCCESS, FAILURE or SKIPPED."},
                    {.name = "value",
                     .type = element,
                     .direction = Direction::kOutput,
                     .required = true,
                     .description = "The entry that gets the element."}},
          .description = "The child once for each element of a queue."};
}

Loop::Loop(const NodeSetup& setup, PortType element)
    : Composite(setup),
      element_(element),
      queue_(setup.port("queue")),
      if_empty_(setup, "if_empty"),
      value_(setup, "value") {}

std::string Loop::checkBuilt() const {
  const auto text = if_empty_.get();
  return text ? notAnAnswer("if_empty", *text) : std::string();
}

void Loop::clear(TickContext&) {
  if (queue_.literal) own_ = std::get<std::string>(*queue_.literal);
}

const std::string* Loop::left() const {
  if (queue_.slot == nullptr) return isActive(status()) ? &own_ : &std::get<std::string>(*queue_.literal);
  return queue_.slot->value ? std::get_if<std::string>(&*queue_.slot->value) : nullptr;
}

bool Loop::onAsked(const TickContext& context) const {
  const std::string* queue = left();
  const auto text = if_empty_.get();
  const bool empty = queue == nullptr || queue->empty();
  return !empty || !text || *text != "SKIPPED" || Composite::onAsked(context);
}

Status Loop::run(TickContext& context) {
  if (!isActive(child().status())) {
    const std::string* queue = queue_.slot == nullptr ? &own_ : left();
    if (queue == nullptr || queue->empty()) {
      const auto status = answerFrom(if_empty_.get().value_or(""));
      return status ? *status : fail(context, if_empty_.problem());
    }
    if (!takeNext(context, std::string(*queue))) return Status::kFailure;
  }
  return child().tick(context) == Status::kFailure ? Status::kFailure : Status::kRunning;
}

bool Loop::takeNext(TickContext& context, const std::string& queue) {
  const std::size_t end = queue.find(';');
  const std::string first = queue.substr(0, end);
  const std::string rest = end == std::string::npos ? "" : queue.substr(end + 1);
  if (queue_.slot == nullptr)
    own_ = rest;
  else
    queue_.slot->write(rest);
  auto value = parseValue(first, element_, {});
  if (!value) {
    (void)fail(context, "the element `" + first + "` is not a " + toString(element_));
    return false;
  }
  value_.set(std::move(*value));
  return true;
}

}  // namespace swiftlet::tree
