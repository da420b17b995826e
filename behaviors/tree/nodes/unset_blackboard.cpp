#include "behaviors/tree/nodes/unset_blackboard.hpp"

namespace swiftlet::tree {

NodeManifest UnsetBlackboard::manifest() {
  return {.id = "UnsetBlackboard",
          .kind = NodeKind::kAction,
          .ports = {{.name = "key",
                     .type = PortType::kAny,
                     .direction = Direction::kOutput,
                     .required = true,
                     .description = "The entry that loses its value.",
                     .unsets = true}},
          .description = "Takes the value of a blackboard entry away.",
          .may_fail = false};
}

Status UnsetBlackboard::act(TickContext&) {
  if (key_ != nullptr) key_->value.reset();
  return Status::kSuccess;
}

}  // namespace swiftlet::tree
