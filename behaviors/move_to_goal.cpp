#include "behaviors/move_to_goal.hpp"

#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest MoveToGoal::manifest() {
  return {.id = "MoveToGoal",
          .kind = tree::NodeKind::kAction,
          .ports = {{.name = "goal",
                     .type = tree::PortType::kPoint,
                     .required = true,
                     .description = "In the map frame, whose origin is the take-off pose; z above the take-off floor."},
                    tolerancePort(),
                    clearancePort()},
          .description = "Flies to a point of the map."};
}

MoveToGoal::MoveToGoal(const tree::NodeSetup& setup)
    : IntentLeaf(setup), goal_(setup, "goal"), tolerance_m_(setup, "tolerance_m"), clearance_m_(setup, "clearance_m") {}

IntentLeaf::IntentOrProblem MoveToGoal::makeIntent(const FlightTick& tick) {
  const auto goal = goal_.get();
  const auto tolerance_m = tolerance_m_.get();
  const auto clearance_m = clearance_m_.get();
  if (!goal) return {std::nullopt, goal_.problem()};
  if (!tolerance_m) return {std::nullopt, tolerance_m_.problem()};
  if (!clearance_m) return {std::nullopt, clearance_m_.problem()};
  common::GoToIntent intent;
  intent.goal_map_m = {goal->x, goal->y};
  intent.height_m = goal->z;
  intent.tolerance_m = *tolerance_m;
  intent.clearance_m = *clearance_m;
  // The goal is not judged by the map here, because the map may be about to grow: the executor does that, and waits.
  const auto verdict = common::judgeGoal(common::goalOf(intent), tick.flight.goal_limits, nullptr);
  if (!verdict) return {std::nullopt, verdict.error().text};
  return {intent, {}};
}

}  // namespace swiftlet::behaviors
