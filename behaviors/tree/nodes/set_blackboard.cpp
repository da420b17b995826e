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
                     .description = "Entry that is written."}},
          .description = "Writes a blackboard entry.",
          .may_fail = false};
}

SetBlackboard::SetBlackboard(const NodeSetup& setup)
    : Leaf(setup), value_(setup.port("value")), output_key_(setup, "output_key") {}

Status SetBlackboard::act(TickContext& context) {
  const Slot* entry = value_.slot;
  if (entry != nullptr && !entry->value) return fail(context, "port value: the entry {" + entry->name + "} is not set");
  if (entry != nullptr)
    output_key_.copy(*entry);
  else
    output_key_.set(*value_.literal);
  return Status::kSuccess;
}

}  // namespace swiftlet::tree
