// Commands of the operator, from the page or a tablet, and the answers. Land is always accepted. The others are
// refused, with a reason, while the vehicle lands, and when the mission or the map does not allow them.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include <Eigen/Core>

namespace swiftlet::common {

struct HoldCommand {};
struct ResumeCommand {};
struct HomeCommand {};
struct LandCommand {};
struct GoalCommand {
  Eigen::Vector2d goal_map_m = Eigen::Vector2d::Zero();
};

/// Another controller takes over, without a step.
struct ControllerCommand {
  std::string controller;  ///< A word of `controller.kind` in a system profile.
};

struct OperatorCommand {
  std::uint64_t id = 0;
  std::variant<HoldCommand, ResumeCommand, HomeCommand, LandCommand, GoalCommand, ControllerCommand> kind;
};

struct CommandResult {
  std::uint64_t id = 0;
  bool accepted = false;
  std::string reason;  ///< Why it was refused; of an accepted one what comes before it or next, if anything does.
};

std::string toString(const OperatorCommand& command);

}  // namespace swiftlet::common
