#include "autonomy/maneuvers/detour.hpp"

#include <algorithm>
#include <utility>

namespace swiftlet::autonomy {
using common::Time;

Detour::Detour(const ManeuverSetup& setup, PathFlight& flight)
    : config_(setup.config), memory_(setup.memory), flight_(flight) {}

bool Detour::due(Time stuck_since, Time now, const std::optional<Eigen::Vector2d>& blocked_map_m) const {
  constexpr double kSame_m = 0.4;  // Farther away it may be out of sight. Somebody who stands sways by less.
  const bool same = !blocked_map_m || !blocked_map_m_ || (*blocked_map_m - *blocked_map_m_).norm() < kSame_m;
  if (flight_.plan() || (same && asked_ >= (blocked_map_m ? 1 : 2))) return false;
  return (now - std::max(stuck_since, since_.value_or(stuck_since))).seconds() >= config_.detour_after_s;
}

void Detour::ask(const ManeuverInput& input, const Eigen::Vector2d& goal_map_m,
                 const std::optional<Eigen::Vector2d>& blocked_map_m) {
  since_ = input.now;
  blocked_map_m_ = blocked_map_m;
  ++asked_;
  flight_.ask(input, DetourRequest{goal_map_m, blocked_map_m, blocked_map_m && asked_ > 1});
}

Progress Detour::begin(const DetourPlan& plan, std::string reason, Time now, const common::VehicleState& state) {
  active_ = true;
  const std::string what = plan.makes_room ? "moves aside to make room" : "moves closer to look";
  memory_.log.info(now, kFlightSource, what, std::move(reason));
  flight_.offer(plan.path, now, state);
  return Progress::running("detour: " + what);
}

void Detour::endWhenOver(const ManeuverInput& input) {
  if (!active_) return;
  if (const planning::Path* path = flight_.plan()) {
    const Eigen::Vector2d left_m = path->points_map_m.back() - input.position_map_m();
    if (left_m.norm() > kViewpointTolerance_m) return;
  }
  active_ = false;
  since_ = input.now;
  flight_.abandon();
}

void Detour::breakOff() {
  asked_ = 0;
  if (std::exchange(active_, false)) flight_.release();
}

}  // namespace swiftlet::autonomy
