#include "evaluation/contact_replay.hpp"

#include <algorithm>
#include <limits>

namespace swiftlet::evaluation {
namespace {

using Eigen::Vector2d;

/// Braking of a vehicle that is told to stand, and its descent: those of the shipped profiles.
constexpr double kBraking_m_s2 = 1.0, kDescent_m_s = 0.4;
/// A vehicle that stood, instead of flying away from a person or towards one, is met sooner or later: by what it flew
/// in 2 s, over the speed of a person.
constexpr double kAfter_s = 1.0, kStep_s = 0.02;
/// Lower than this over where it stood last it stands there.
constexpr double kStands_m = 0.05;

Vector2d placeAfter(const ReplayTick& from, double time_s) {
  const Vector2d velocity = from.velocity_world_m_s.head<2>();
  const double speed_m_s = velocity.norm(), moving_s = std::min(time_s, speed_m_s / kBraking_m_s2);
  if (speed_m_s <= 0.0) return from.position_world_m.head<2>();
  return from.position_world_m.head<2>() +
         velocity / speed_m_s * (speed_m_s * moving_s - 0.5 * kBraking_m_s2 * moving_s * moving_s);
}

double nearest_m(const std::vector<Vector2d>& people, const Vector2d& place) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Vector2d& person : people) least_m = std::min(least_m, (person - place).norm());
  return least_m;
}

}  // namespace

ContactReplay replay(std::span<const ReplayTick> ticks) {
  if (ticks.size() < 2 || ticks.back().people_world_m.empty()) return {};
  const ReplayTick &first = ticks.front(), &last = ticks.back(), &before = ticks[ticks.size() - 2];
  constexpr double kRounding_m = 1e-6;
  const double touch_m = nearest_m(last.people_world_m, last.position_world_m.head<2>()) + kRounding_m;
  const bool stood = first.above_floor_m < kStands_m;
  const double down_s = stood ? std::numeric_limits<double>::infinity() : first.above_floor_m / kDescent_m_s;
  ContactReplay result;
  const auto look = [&](const std::vector<Vector2d>& people, double time_s) {
    if (nearest_m(people, placeAfter(first, time_s)) > touch_m) return;
    result.standing = true;
    result.landing = result.landing || time_s < down_s;
  };
  for (const ReplayTick& tick : ticks) look(tick.people_world_m, (tick.stamp - first.stamp).seconds());
  const double step_s = (last.stamp - before.stamp).seconds(), until_s = (last.stamp - first.stamp).seconds();
  if (step_s <= 0.0 || before.people_world_m.size() != last.people_world_m.size()) return result;
  std::vector<Vector2d> people = last.people_world_m;
  for (double after_s = kStep_s; after_s <= kAfter_s; after_s += kStep_s) {
    for (std::size_t i = 0; i < people.size(); ++i)
      people[i] += (last.people_world_m[i] - before.people_world_m[i]) * (kStep_s / step_s);
    look(people, until_s + after_s);
  }
  return result;
}

}  // namespace swiftlet::evaluation
