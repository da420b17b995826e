#include "behaviors/tree/nodes/set_blackboard.hpp"

namespace swiftlet::tree {

NodeManifest SetBlackboard::manifest() {
  return {.id = "SetBlackboard",
          .kind = NodeKind::kAction,
          .ports = {{.name = "value",
                     .type = PortType::kAny,
                     .required = true,
                     .description = "What is written: text, or an entry {x} to copy."},
                    {.name = "output_key",
                     .type = PortType::kAny,
                     .direction = Direction::kOutput,
                     .required = true,
                     .description = "The entry it is written to."}},
          .description = "Writes a blackboard entry."};
}

SetBlackboard::SetBlackboard(const NodeSetup& setup)
    : Leaf(setup), value_(setup.port("value")), output_key_(setup, "output_key") {}

Status SetBlackboard::act(TickContext& context) {
  const std::optional<Value>& value = value_.slot != nullptr ? value_.slot->value : value_.literal;
  if (!value) return fail(context, "port value: the entry {" + value_.slot->name + "} is not set");
  output_key_.set(*value);
  return Status::kSuccess;
}

}  // namespace swiftlet::tree
