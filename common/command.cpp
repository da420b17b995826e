#include "common/command.hpp"

#include <fmt/format.h>

namespace swiftlet::common {
namespace {

struct Describe {
  std::string operator()(const HoldCommand&) const { return "hold"; }
  std::string operator()(const ResumeCommand&) const { return "resume"; }
  std::string operator()(const HomeCommand&) const { return "home"; }
  std::string operator()(const LandCommand&) const { return "land"; }
  std::string operator()(const ControllerCommand& c) const { return "controller " + c.controller; }
  std::string operator()(const GoalCommand& c) const {
    const Eigen::Vector2d& place = c.goal_given_m.value_or(c.goal_map_m);
    return fmt::format("goal ({:.2f}, {:.2f}){}", place.x(), place.y(), c.goal_given_m ? " in the given map" : "");
  }
  std::string operator()(const StartMissionCommand& c) const { return fmt::format("mission {}", c.name); }
  std::string operator()(const StopMissionCommand&) const { return "stop the mission"; }
  std::string operator()(const KeepOutCommand& c) const {
    if (c.corners_given_m.empty()) return "keep-out zone with " + toString(c.area);
    return "keep-out zone with " + toString(Polygon{c.corners_given_m}) + " in the given map";
  }
  std::string operator()(const ClearKeepOutCommand&) const { return "no keep-out zones"; }
  std::string operator()(const GoOnCommand&) const { return "go on"; }
};

}  // namespace

std::string toString(const OperatorCommand& command) { return std::visit(Describe{}, command.kind); }

}  // namespace swiftlet::common
