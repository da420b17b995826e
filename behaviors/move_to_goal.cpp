#include "behaviors/move_to_goal.hpp"

#include "behaviors/ports.hpp"
#include "common/geometry.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest MoveToGoal::manifest() {
  return {
      .id = "MoveToGoal",
      .kind = tree::NodeKind::kAction,
      .ports = {placePort("goal"),
                tolerancePort(),
                clearancePort(),
                {.name = "height_m",
                 .type = tree::PortType::kDouble,
                 .description = "Above the take-off floor, where the goal has no z. Not given: the present height."},
                {.name = "yaw_deg",
                 .type = tree::PortType::kDouble,
                 .minimum = -360.0,
                 .maximum = 360.0,
                 .description = "Heading at the goal in the map frame, counter-clockwise. Not given: any."},
                modePort()},
      .description = "Flies to a point of the map."};
}

MoveToGoal::MoveToGoal(const tree::NodeSetup& setup)
    : IntentLeaf(setup),
      goal_(setup, "goal"),
      go_to_(setup),
      height_m_(setup, "height_m"),
      yaw_deg_(setup, "yaw_deg") {}

IntentLeaf::IntentOrProblem MoveToGoal::makeIntent(const FlightTick& tick) {
  const auto goal = goal_.get();
  if (!goal) return {std::nullopt, goal_.problem()};
  auto intent = go_to_.intentTo(*goal, tick.mode);
  if (!intent) return {std::nullopt, intent.error()};
  const auto height_m = height_m_.get();
  const auto yaw_deg = yaw_deg_.get();
  if (height_m_.given() && !height_m) return {std::nullopt, height_m_.problem()};
  if (yaw_deg_.given() && !yaw_deg) return {std::nullopt, yaw_deg_.problem()};
  if (!intent->height_m) intent->height_m = height_m;
  if (yaw_deg) intent->yaw_map_rad = *yaw_deg * common::kRadPerDeg;
  const common::MapLayer& map = *tick.flight.world->map;
  if (map.localization) {
    if (!map.T_map_given) return {std::nullopt, "its place in the given map is not known"};
    intent->goal_given_m = intent->goal_map_m;
    intent->goal_map_m = *map.T_map_given * *intent->goal_given_m;
    if (yaw_deg) intent->yaw_map_rad = common::wrapAngle(map.T_map_given->yaw_rad + *intent->yaw_map_rad);
  }
  emitted_map_m_ = intent->goal_map_m;
  // The goal is not judged by the map here, because the map may be about to grow: the executor does that, and waits.
  const auto verdict = common::judgeGoal(common::goalOf(*intent), tick.flight.goal_limits, nullptr);
  if (!verdict) return {std::nullopt, verdict.error().text};
  return {*intent, {}};
}

/// The localization has moved the given map, and with it the goal, or has lost it.
bool MoveToGoal::isOutdated(const FlightTick& tick) const {
  constexpr double kMoved_m = 0.03;
  const common::MapLayer& map = *tick.flight.world->map;
  const auto goal = goal_.get();
  if (!map.localization || !goal) return false;
  return !map.T_map_given || (*map.T_map_given * Eigen::Vector2d(goal->x, goal->y) - emitted_map_m_).norm() > kMoved_m;
}

}  // namespace swiftlet::behaviors
