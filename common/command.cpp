#include "common/command.hpp"

#include <fmt/format.h>

namespace swiftlet::common {
namespace {

struct Describe {
  const PlaceNames& names;

  std::string operator()(const HoldCommand&) const { return "hold"; }
  std::string operator()(const ResumeCommand&) const { return "resume"; }
  std::string operator()(const HomeCommand&) const { return "home"; }
  std::string operator()(const LandCommand&) const { return "land"; }
  std::string operator()(const ControllerCommand& c) const { return "controller " + c.controller; }
  std::string operator()(const GoalCommand& c) const {
    return "goal " + (c.goal_given_m ? nameOfGivenPlace(*c.goal_given_m) : names.of(c.goal_map_m));
  }
  std::string operator()(const StartMissionCommand& c) const { return fmt::format("mission {}", c.name); }
  std::string operator()(const StopMissionCommand&) const { return "stop the mission"; }
  std::string operator()(const KeepOutCommand& c) const {
    return "keep-out zone with " + (c.corners_given_m.empty()
                                        ? toString(c.area, names)
                                        : toString(Polygon{c.corners_given_m}, PlaceNames{Pose2{}}));
  }
  std::string operator()(const ClearKeepOutCommand&) const { return "no keep-out zones"; }
  std::string operator()(const GoOnCommand&) const { return "go on"; }
};

}  // namespace

std::string toString(const OperatorCommand& command, const PlaceNames& names) {
  return std::visit(Describe{names}, command.kind);
}

}  // namespace swiftlet::common
