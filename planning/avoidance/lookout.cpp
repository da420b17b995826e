#include "planning/avoidance/lookout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace swiftlet::planning {
namespace {

using Eigen::Vector2d;

/// Somebody who comes into view nearer than this can be too near to evade: 1.4 m/s [Browning 2006] times the 2 s that
/// the vehicle needs.
constexpr double kNear_m = 2.8;
/// What was seen this long ago is as unknown as what never was: in that time a person walks kNear_m.
constexpr double kForgotten_s = 2.0;
/// Share of the weight of a direction that was just seen: it is unknown a moment after the turn.
constexpr double kJustSeen = 0.25;
/// Within the outermost beams people are lost as the vehicle turns and tilts.
constexpr double kMargin_rad = 20.0 * common::kRadPerDeg;
/// A person 1 m away, and the course, each with what it costs by the radian outside, in units of a direction that is
/// wholly open and forgotten: a person who is known and near counts more than all of these.
constexpr double kPerson = 40.0, kCourse = 6.0;
constexpr double kOutside = 0.5;
/// Share of that cost for each 15 deg of a turn, a quarter of a second, during which a person is not seen.
constexpr double kOnTheWay = 0.5;
/// People are seen where they are and where they soon will be.
constexpr double kSoon_s = 0.7;
/// Cost of a turn by a radian, and of another heading than the last one, in the same units.
constexpr double kTurn_1_rad = 0.5, kOther = 0.7;
/// Slower than this it has no course.
constexpr double kLeast_m_s = 0.1;
constexpr int kHeadings = 36;

double bearingOf(const Vector2d& p) { return std::atan2(p.y(), p.x()); }

}  // namespace

Lookout::Lookout(double field_of_view_deg, double hull_radius_m)
    : half_field_rad_(0.5 * field_of_view_deg * common::kRadPerDeg), hull_radius_m_(hull_radius_m) {}

bool Lookout::sees(double bearing_level_rad, double margin_rad) const {
  return std::abs(common::wrapAngle(bearing_level_rad)) <= half_field_rad_ - margin_rad;
}

/// How much it matters that a direction is not seen: in [0, 1].
double Lookout::weightOf(const LookoutInput& input, int direction) const {
  const double bearing_map_rad = 2.0 * std::numbers::pi * direction / kDirections;
  const double age_s = (input.stamp - seen_[static_cast<std::size_t>(direction)]).seconds();
  const double unknown = kJustSeen + (1.0 - kJustSeen) * std::clamp(age_s / kForgotten_s, 0.0, 1.0);
  if (input.clearance == nullptr) return unknown;
  const Clearance& clearance = *input.clearance;
  const Vector2d along(std::cos(bearing_map_rad), std::sin(bearing_map_rad));
  // As far as nothing stands a person may come.
  double open_m = hull_radius_m_;
  while (open_m < kNear_m) {
    const double free_m =
        clearance.at_m(Vector2d(input.T_map_level.position_m() + open_m * along), Against::kObstacles);
    if (free_m < clearance.resolution_m()) break;
    open_m += std::max(clearance.resolution_m(), free_m);
  }
  return unknown * std::clamp((open_m - 2.0 * hull_radius_m_) / (kNear_m - 2.0 * hull_radius_m_), 0.0, 1.0);
}

double Lookout::turn_rad(const LookoutInput& input) {
  const double yaw_rad = input.T_map_level.yaw_rad;
  std::array<double, kDirections> weights;
  for (int i = 0; i < kDirections; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (sees(2.0 * std::numbers::pi * i / kDirections - yaw_rad, 0.0)) seen_[at] = input.stamp;
    weights[at] = weightOf(input, i);
  }
  const auto outside_rad = [&](const Vector2d& p, double turn_rad) {
    return std::max(0.0, std::abs(common::wrapAngle(bearingOf(p) - turn_rad)) - half_field_rad_ + kMargin_rad);
  };
  const auto peopleUnseen = [&](double turn_rad) {
    double cost = 0.0;
    for (const NearPerson& person : input.people) {
      for (const double time_s : {0.0, kSoon_s}) {
        const double outside = outside_rad(person.place_m + time_s * person.velocity_m_s, turn_rad);
        if (outside > 0.0) cost += 0.5 * kPerson * (kOutside + outside) / std::max(1.0, person.place_m.norm());
      }
    }
    return cost;
  };
  const auto costOf = [&](double turn_rad) {
    double cost = kTurn_1_rad * std::abs(turn_rad) + peopleUnseen(turn_rad);
    // Nobody is to be out of sight during the turn either.
    constexpr double kStep_rad = std::numbers::pi / 12.0;
    for (double turned_rad = kStep_rad; turned_rad < std::abs(turn_rad); turned_rad += kStep_rad)
      cost += kOnTheWay * std::max(0.0, peopleUnseen(std::copysign(turned_rad, turn_rad)) - peopleUnseen(0.0));
    for (int i = 0; i < kDirections; ++i)
      if (!sees(2.0 * std::numbers::pi * i / kDirections - yaw_rad - turn_rad, kMargin_rad))
        cost += weights[static_cast<std::size_t>(i)];
    if (input.course_level_m_s.norm() > kLeast_m_s) cost += kCourse * outside_rad(input.course_level_m_s, turn_rad);
    if (std::abs(common::wrapAngle(yaw_rad + turn_rad - aim_map_rad_)) > std::numbers::pi / kHeadings) cost += kOther;
    return cost;
  };
  double best_rad = common::wrapAngle(aim_map_rad_ - yaw_rad), least = costOf(best_rad);
  for (int i = 0; i < kHeadings; ++i) {
    const double turn_rad = common::wrapAngle(2.0 * std::numbers::pi * i / kHeadings);
    const double cost = costOf(turn_rad);
    if (cost >= least - 1e-9) continue;
    least = cost;
    best_rad = turn_rad;
  }
  aim_map_rad_ = common::wrapAngle(yaw_rad + best_rad);
  return best_rad;
}

}  // namespace swiftlet::planning
