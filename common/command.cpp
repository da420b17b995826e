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
    return fmt::format("goal ({:.2f}, {:.2f})", c.goal_map_m.x(), c.goal_map_m.y());
  }
};

}  // namespace

std::string toString(const OperatorCommand& command) { return std::visit(Describe{}, command.kind); }

}  // namespace swiftlet::common
