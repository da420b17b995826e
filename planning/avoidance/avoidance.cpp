#include "planning/avoidance/avoidance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "planning/avoidance/retreat.hpp"
#include "planning/avoidance/retreat_rules.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Step of predictions: at 1.5 m/s a person moves by 15 cm, less than the outline of a body.
constexpr double kTimeStep_s = 0.1;
/// A slower velocity has no direction.
constexpr double kStill_m_s = 1e-3;
/// A return this near to the outline of a tracked person is the person: an arm, or half a stride ahead of the track.
constexpr double kSameBody_m = 0.3;
/// Something moving that would arrive within this time makes the vehicle retreat.
constexpr double kContactTime_s = 1.8;
/// An obstacle that approaches more slowly than this does not count as moving.
constexpr double kClosingSpeed_m_s = 0.15;
/// A return this near to something mapped or unknown is not unmapped.
constexpr double kMappedWithin_m = 0.15;
/// A retreat ends this long after the danger.
constexpr double kCalm_s = 0.6;
/// While retreating the vehicle turns until the danger and its course are this far within the field of view (decision
/// 009).
constexpr double kViewMargin_deg = 30.0;
/// A door of 0.8 m leaves a hull of 0.55 m this much on either side, less 2 cm.
constexpr double kDoor_m = 0.105;

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

/// How far a disc of `radius_m` at the origin may move before it touches the point; infinity if it passes by.
double gapAlong(const Point& direction, const Point& point_m, double radius_m) {
  const double ahead_m = point_m.dot(direction), aside_m = std::abs(cross(direction, point_m));
  if (ahead_m <= 0.0 || aside_m >= radius_m) return kInfinity;
  if (point_m.norm() <= radius_m) {
    // The point is already nearer than the radius: moving past it is allowed, moving closer is not.
    constexpr double kSlide = 0.2;
    return ahead_m > kSlide * point_m.norm() ? 0.0 : kInfinity;
  }
  return ahead_m - std::sqrt(radius_m * radius_m - aside_m * aside_m);
}

std::string bearingInWords(const Point& p) {
  return fmt::format("{:.0f} deg", std::atan2(p.y(), p.x()) * 180.0 / std::numbers::pi);
}

}  // namespace

double stoppingSpeed_m_s(double gap_m, double deceleration_m_s2, double delay_s) {
  const double a = deceleration_m_s2, t = delay_s;
  return std::sqrt(a * a * t * t + 2.0 * a * gap_m) - a * t;
}

Avoidance::Avoidance(const Config& config, double hull_radius_m) : config_(config), hull_radius_m_(hull_radius_m) {}

AvoidanceDecision Avoidance::update(const AvoidanceInput& input) {
  // Since the scan the vehicle has flown on, as it will until the command acts.
  const double latency_s = config_.latency_s + std::max(0.0, input.age_s);
  const Points returns = smoothed(config_, input.points_level_m);
  std::vector<Bin> sectors = bins(config_, returns);
  Points points = returns;
  if (config_.bin_range == BinRange::kMean) {
    points.clear();
    for (const Bin& bin : sectors)
      if (std::isfinite(bin.range_m)) points.push_back(bin.nearest_level_m);
  }
  for (const Eigen::Vector2f& p : input.map3d_points_level_m) points.push_back(p.cast<double>());
  shorten(config_, input.map3d_points_level_m, sectors);
  const auto seen_points = static_cast<std::ptrdiff_t>(points.size());
  points.insert(points.end(), input.keep_out_points_level_m.begin(), input.keep_out_points_level_m.end());
  const std::vector<Threat> around = threats(input, sectors);
  for (const Threat& threat : around) {
    if (!threat.dangerous) continue;
    danger_stamp_ = input.stamp;
    danger_ = threat.why;
    retreating_ = true;
    break;
  }
  if (retreating_ && (input.stamp - danger_stamp_).seconds() > kCalm_s) {
    retreating_ = false;
    last_retreat_level_.setZero();
  }

  AvoidanceDecision decision;
  const double speed_m_s = input.velocity_level_m_s.norm();
  const bool moves = input.wanted_level_m_s.norm() > kStill_m_s;
  const Point& course = moves ? input.wanted_level_m_s : input.velocity_level_m_s;
  decision.speed_limit_m_s = config_.max_speed_m_s;
  if (course.norm() > kStill_m_s) {
    decision.speed_limit_m_s = speedLimit(course.normalized(), points, latency_s + config_.lag_s);
    const double intended_m_s = std::min(course.norm(), decision.speed_limit_m_s);
    const double yielding_m_s = yieldingSpeed(course.normalized(), speed_m_s, intended_m_s, around, latency_s);
    if (yielding_m_s < intended_m_s) decision.speed_limit_m_s = yielding_m_s;
  }
  if (retreating_) {
    last_retreat_level_ = retreat(input, points, around, latency_s);
    decision.retreat_velocity_level_m_s = last_retreat_level_;
    decision.retreat_acceleration_m_s2 = config_.deceleration_m_s2;
    decision.turn_rad = turnToSee(around, last_retreat_level_);
  }

  common::AvoidanceStatus& status = decision.status;
  status.nearest_m = kInfinity;
  for (auto p = points.begin(); p != points.begin() + seen_points; ++p) {
    const double gap_m = p->norm() - hull_radius_m_;
    if (gap_m >= status.nearest_m) continue;
    status.nearest_m = gap_m;
    decision.nearest_level_m = *p;
  }
  const double wanted_m_s = std::max(input.wanted_level_m_s.norm(), speed_m_s);
  status.braking = wanted_m_s > kStill_m_s && decision.speed_limit_m_s < wanted_m_s;
  status.retreating = retreating_;
  if (retreating_)
    status.reason = danger_;
  else if (status.braking)
    status.reason =
        fmt::format("at most {:.2f} m/s, nearest {:.2f} m off the hull", decision.speed_limit_m_s, status.nearest_m);
  return decision;
}

bool Avoidance::isMapped(const AvoidanceInput& input, const Point& point_level_m) const {
  const common::CellIndex cell = input.cost_map->cellAt(input.T_map_level * point_level_m);
  return input.cost_map->states().at(cell) != CellState::kFree ||
         input.cost_map->obstacleDistance_m(cell) <= kMappedWithin_m;
}

std::vector<Threat> Avoidance::threats(const AvoidanceInput& input, const std::vector<Bin>& bins) const {
  const double slack = retreating_ ? config_.release_factor : 1.0;
  std::vector<Threat> result;
  const common::Pose2 T_level_map = input.T_map_level.inverse();
  const Eigen::Rotation2Dd to_level(T_level_map.yaw_rad);
  for (const common::DynamicObstacle& o : input.obstacles) {
    const double age_s = std::max(0.0, (input.stamp - o.last_seen).seconds());
    const bool moving = o.moving && o.velocity_map_m_s.norm() >= kClosingSpeed_m_s;
    const Point velocity_map_m_s = moving ? o.velocity_map_m_s : Point::Zero();
    Threat threat{T_level_map * Point(o.center_map_m + velocity_map_m_s * age_s), o.radius_m,
                  to_level * velocity_map_m_s, false, ""};
    const double gap_m = threat.gapTo(hull_radius_m_, Point::Zero(), 0.0);
    const bool leaving = moving && threat.velocity_m_s.dot(threat.center_m) > 0.0;
    double least_m = gap_m;
    for (double t = kTimeStep_s; t <= kContactTime_s * slack; t += kTimeStep_s)
      least_m = std::min(least_m, threat.gapTo(hull_radius_m_, Point::Zero(), t));
    const bool near = gap_m < config_.retreat_distance_m * slack;
    const bool closing = moving && least_m < config_.contact_gap_m * slack;
    threat.dangerous = (near || closing) && !leaving;
    if (threat.dangerous)
      threat.why =
          fmt::format("{} {:.2f} m off the hull at {}", closing ? "something closing in," : "something unmapped", gap_m,
                      bearingInWords(threat.center_m));
    result.push_back(threat);
  }
  if (input.cost_map == nullptr) return result;
  const auto followed_count = static_cast<std::ptrdiff_t>(result.size());
  for (const Bin& bin : bins) {
    if (!std::isfinite(bin.range_m)) continue;
    const double gap_m = bin.range_m - hull_radius_m_;
    const bool overruns = cannotStopBefore(bin.nearest_level_m, slack * input.velocity_level_m_s);
    if (!overruns && gap_m >= config_.retreat_distance_m * slack) continue;
    const bool mapped = isMapped(input, bin.nearest_level_m);
    const bool known = input.position_sigma_m <= kMappedWithin_m;
    if (!overruns && mapped && (known || gap_m >= kDoor_m * slack)) continue;
    const bool followed = std::any_of(result.begin(), result.begin() + followed_count, [&](const Threat& t) {
      return (t.center_m - bin.nearest_level_m).norm() <= t.radius_m + kSameBody_m;
    });
    if (followed) continue;
    const std::string_view what = overruns ? "too fast for something"
                                  : mapped ? "something near"
                                           : "something unmapped";
    result.push_back({bin.nearest_level_m, 0.0, Point::Zero(), true,
                      fmt::format("{} {:.2f} m off the hull at {}", what, gap_m, bearingInWords(bin.nearest_level_m))});
  }
  return result;
}

/// Whether braking with the deceleration that the speed limit assumes would not keep the hull from the point. An intent
/// that obeys the limit has begun to brake before, so no latency is added.
bool Avoidance::cannotStopBefore(const Point& point_level_m, const Point& velocity_level_m_s) const {
  const double speed_m_s = velocity_level_m_s.norm();
  if (speed_m_s <= kStill_m_s) return false;
  const double gap_m = gapAlong(velocity_level_m_s / speed_m_s, point_level_m, hull_radius_m_);
  return gap_m < kInfinity && speed_m_s > stoppingSpeed_m_s(gap_m, config_.deceleration_m_s2, 0.0);
}

double Avoidance::speedLimit(const Point& direction, const Points& points, double delay_s) const {
  double gap_m = kInfinity;
  for (const Point& p : points) gap_m = std::min(gap_m, gapAlong(direction, p, hull_radius_m_ + config_.margin_m));
  // Outside the field of view only mapped obstacles are known, but no people.
  const double most_m_s = isSeen(direction) ? config_.max_speed_m_s : config_.blind_speed_m_s;
  return gap_m < kInfinity ? std::min(most_m_s, stoppingSpeed_m_s(gap_m, config_.deceleration_m_s2, delay_s))
                           : most_m_s;
}

bool Avoidance::isSeen(const Point& direction) const {
  return std::abs(std::atan2(direction.y(), direction.x())) <=
         0.5 * config_.field_of_view_deg * std::numbers::pi / 180.0;
}

double Avoidance::yieldingSpeed(const Point& direction, double speed_m_s, double intended_m_s,
                                const std::vector<Threat>& threats, double latency_s) const {
  // Within the horizon a person at 1.5 m/s walks 3.75 m.
  constexpr double kStep_m_s = 0.1, kHorizon_s = 2.5;
  const double a = config_.deceleration_m_s2;
  const auto leastGap = [&](const Threat& threat, double v) {
    double moved_m = 0.0, now_m_s = speed_m_s, least_m = kInfinity;
    for (double time_s = 0.0; time_s <= kHorizon_s; time_s += kTimeStep_s) {
      least_m = std::min(least_m, threat.gapTo(hull_radius_m_, moved_m * direction, time_s));
      if (time_s >= latency_s) now_m_s += std::clamp(v - now_m_s, -a * kTimeStep_s, a * kTimeStep_s);
      moved_m += now_m_s * kTimeStep_s;
    }
    return least_m;
  };
  double result_m_s = intended_m_s;
  for (const Threat& threat : threats) {
    if (threat.velocity_m_s.isZero()) continue;
    // An obstacle inside the gap may come no nearer than it would if the vehicle stopped at once.
    const double enough_m = std::min(config_.release_factor * config_.contact_gap_m, leastGap(threat, 0.0) - 1e-6);
    while (result_m_s > 0.0 && leastGap(threat, result_m_s) < enough_m) result_m_s -= kStep_m_s;
  }
  return std::max(0.0, result_m_s);
}

Point Avoidance::retreat(const AvoidanceInput& input, const Points& points, const std::vector<Threat>& threats,
                         double latency_s) const {
  // The danger may have passed only for a moment, so the state lasts until it has been gone for 0.6 s.
  if (std::none_of(threats.begin(), threats.end(), [](const Threat& t) { return t.dangerous; })) return Point::Zero();
  const RetreatInput retreat{input.velocity_level_m_s, points,         threats,  last_retreat_level_,
                             input.T_map_level,        input.cost_map, latency_s};
  switch (config_.retreat_rule) {
    case RetreatRule::kOpposite:
      return oppositeVelocity(config_, hull_radius_m_, retreat);
    case RetreatRule::kPotentialField:
      return potentialFieldVelocity(config_, hull_radius_m_, retreat);
    case RetreatRule::kClearCourse:
      break;
  }
  return retreatVelocity(config_, hull_radius_m_, retreat);
}

/// The turn that brings the nearest threat and the course of the retreat into the laser's field of view. Outside it, a
/// person is soon lost by the tracker, and an obstacle on the course is not seen.
double Avoidance::turnToSee(const std::vector<Threat>& threats, const Point& retreat_level_m_s) const {
  // Losing sight of the danger costs more than losing sight of the course, and each more than turning
  // (docs/decisions/avoidance.md#009).
  constexpr double kStep_rad = std::numbers::pi / 36.0, kDanger = 4.0, kCourse = 2.0, kLeast_m_s = 0.1;
  const Threat* nearest = nullptr;
  for (const Threat& threat : threats) {
    if (!threat.dangerous && threat.velocity_m_s.isZero()) continue;
    if (nearest == nullptr || threat.center_m.norm() < nearest->center_m.norm()) nearest = &threat;
  }
  if (nearest == nullptr) return 0.0;
  const double seen_rad = (0.5 * config_.field_of_view_deg - kViewMargin_deg) * std::numbers::pi / 180.0;
  const auto outside_rad = [&](const Point& direction, double turn_rad) {
    const double bearing_rad = common::wrapAngle(std::atan2(direction.y(), direction.x()) - turn_rad);
    return std::max(0.0, std::abs(bearing_rad) - seen_rad);
  };
  double best_rad = 0.0, least_cost = kInfinity;
  for (int i = 0; i <= 36; ++i) {
    for (const double turn_rad : {i * kStep_rad, -i * kStep_rad}) {
      double cost = std::abs(turn_rad) + kDanger * outside_rad(nearest->center_m, turn_rad);
      if (retreat_level_m_s.norm() > kLeast_m_s) cost += kCourse * outside_rad(retreat_level_m_s, turn_rad);
      if (cost >= least_cost - 1e-9) continue;
      least_cost = cost;
      best_rad = turn_rad;
    }
  }
  return best_rad;
}

}  // namespace swiftlet::planning
