#include "planning/avoidance/avoidance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "planning/avoidance/contact_risk.hpp"
#include "planning/avoidance/retreat.hpp"
#include "planning/avoidance/retreat_rules.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A slower velocity has no direction.
constexpr double kStill_m_s = 1e-3;
/// A return this near to the outline of a tracked person is the person: an arm, or half a stride ahead of the track.
constexpr double kSameBody_m = 0.3;
/// Beyond this range a person does not come near within the 3 s of ContactRisk.
constexpr double kPersonRange_m = 6.0;
/// The vehicle leaves its path, or its place, where that lowers the probability of meeting a person by this much.
constexpr double kWorthLeaving = 0.04;
/// Where the probability is this high on every course, none is free: that of a person who comes straight on and is 2 s
/// away (half of them go on, and what is later than 1.5 s counts less than half: ContactRisk).
constexpr double kNothingFree = 0.2;
/// It slows down on its path where that lowers the probability by this much.
constexpr double kWorthSlowing = 0.02;
/// An obstacle that approaches more slowly than this does not count as moving.
constexpr double kClosingSpeed_m_s = 0.15;
/// A return this near to something mapped or unknown is not unmapped.
constexpr double kMappedWithin_m = 0.15;
/// What is mapped farther away does not limit a speed of at most AvoidanceConfig::blind_speed_m_s.
constexpr double kBlindReach_m = 1.0;
/// A retreat ends this long after the danger.
constexpr double kCalm_s = 0.6;
/// All of the time for which courses are predicted.
constexpr double kAlways_s = ContactRisk::kSteps * ContactRisk::kStep_s;
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

Avoidance::Avoidance(const Config& config, double hull_radius_m)
    : config_(config), hull_radius_m_(hull_radius_m), lookout_(config.field_of_view_deg, hull_radius_m) {}

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
  std::vector<Threat> around = threats(input, sectors);
  const std::vector<NearPerson> walking = people(input);
  const ContactRisk risk(hull_radius_m_, walking);

  AvoidanceDecision decision;
  const double speed_m_s = input.velocity_level_m_s.norm();
  const bool moves = input.wanted_level_m_s.norm() > kStill_m_s;
  const Point& course = moves ? input.wanted_level_m_s : input.velocity_level_m_s;
  decision.speed_limit_m_s = config_.max_speed_m_s;
  double intended_m_s = 0.0;
  Point ahead = Point::Zero();
  if (course.norm() > kStill_m_s) {
    decision.speed_limit_m_s = speedLimit(input, course.normalized(), points, latency_s + config_.lag_s);
    intended_m_s = std::min(course.norm(), decision.speed_limit_m_s);
    ahead = course.normalized();
  }
  const Slowed slowed = slowedFor(risk, input.velocity_level_m_s, ahead, intended_m_s, latency_s);
  if (slowed.speed_m_s < intended_m_s) decision.speed_limit_m_s = slowed.speed_m_s;

  const double worth = (retreating_ ? 0.5 : 1.0) * kWorthLeaving;
  const RetreatChoice choice = retreat(input, points, around, walking, risk, latency_s);
  const bool leaves = slowed.contact - choice.contact > worth;
  decision.nothing_free = whyNothingIsFree(input, risk, std::min(slowed.contact, choice.contact), latency_s);
  const bool closed_in = leaves || !decision.nothing_free.empty();
  if (closed_in) danger_ = whyLeaving(walking);
  const auto danger = std::ranges::find_if(around, &Threat::dangerous);
  if (danger != around.end()) danger_ = danger->why;
  if (closed_in || danger != around.end()) {
    danger_stamp_ = input.stamp;
    retreating_ = true;
  } else if (retreating_ && (input.stamp - danger_stamp_).seconds() > kCalm_s) {
    retreating_ = false;
  }
  last_retreat_level_ = retreating_ ? choice.velocity_level_m_s : Point(Point::Zero());
  if (retreating_) {
    decision.retreat_velocity_level_m_s = last_retreat_level_;
    decision.retreat_acceleration_m_s2 =
        config_.retreat_rule == RetreatRule::kClearCourse ? kRetreatAcceleration_m_s2 : config_.deceleration_m_s2;
  }
  look(input, around, walking, decision);

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
  const Point place_map_m = input.T_map_level * point_level_m;
  return input.clearance->at_m(place_map_m, Against::kObstacles) <= kMappedWithin_m ||
         input.clearance->at_m(place_map_m, Against::kUnseen) <= 0.0;
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
    threat.dangerous = gap_m < config_.retreat_distance_m * slack && !leaving;
    if (threat.dangerous)
      threat.why =
          fmt::format("something unmapped {:.2f} m off the hull at {}", gap_m, bearingInWords(threat.center_m));
    result.push_back(threat);
  }
  if (input.clearance == nullptr) return result;
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

double Avoidance::speedLimit(const AvoidanceInput& input, const Point& direction, const Points& points,
                             double delay_s) const {
  double gap_m = kInfinity;
  for (const Point& p : points) gap_m = std::min(gap_m, gapAlong(direction, p, hull_radius_m_ + config_.margin_m));
  // Outside the field of view only mapped obstacles are known, but no people.
  const bool seen = isSeen(direction);
  if (!seen) gap_m = std::min(gap_m, mappedGap_m(input, direction));
  const double most_m_s = seen ? config_.max_speed_m_s : config_.blind_speed_m_s;
  return gap_m < kInfinity ? std::min(most_m_s, stoppingSpeed_m_s(gap_m, config_.deceleration_m_s2, delay_s))
                           : most_m_s;
}

/// How far the hull may move before it is nearer than the margin to something mapped; infinity if that is far. Where it
/// is nearer already, it may move past, for which a wall is straight within a cell, and away. A map in which the place
/// of the vehicle is not known says nothing.
double Avoidance::mappedGap_m(const AvoidanceInput& input, const Point& direction) const {
  if (input.clearance == nullptr || input.position_sigma_m > kMappedWithin_m) return kInfinity;
  const Point here_map_m = input.T_map_level.position_m();
  const Point there_map_m = input.T_map_level * Point(kBlindReach_m * direction);
  const double here_m = input.clearance->at_m(here_map_m, Against::kObstacles);
  const double wanted_m = hull_radius_m_ + config_.margin_m;
  const double least_m = here_m < wanted_m ? here_m - input.clearance->resolution_m() : wanted_m;
  const double free_m = input.clearance->freeFor_m(here_map_m, there_map_m, least_m, Against::kObstacles);
  return free_m < kBlindReach_m ? free_m : kInfinity;
}

bool Avoidance::isSeen(const Point& direction) const {
  return std::abs(std::atan2(direction.y(), direction.x())) <=
         0.5 * config_.field_of_view_deg * std::numbers::pi / 180.0;
}

std::vector<NearPerson> Avoidance::people(const AvoidanceInput& input) const {
  std::vector<NearPerson> result;
  const common::Pose2 T_level_map = input.T_map_level.inverse();
  for (const common::DynamicObstacle& o : input.obstacles) {
    if (!o.moving) continue;
    const double unseen_s = std::max(0.0, (input.stamp - o.last_seen).seconds());
    const Point place = T_level_map * Point(o.center_map_m + o.velocity_map_m_s * unseen_s);
    if (place.norm() > kPersonRange_m) continue;
    result.push_back({place, Eigen::Rotation2Dd(T_level_map.yaw_rad) * o.velocity_map_m_s, o.radius_m, unseen_s});
  }
  return result;
}

std::string Avoidance::whyLeaving(const std::vector<NearPerson>& people) const {
  const auto nearest = std::ranges::min_element(people, {}, [](const NearPerson& p) { return p.place_m.norm(); });
  return fmt::format("something closing in, {:.2f} m off the hull at {}",
                     nearest->place_m.norm() - nearest->radius_m - hull_radius_m_, bearingInWords(nearest->place_m));
}

/// The greatest speed ahead at which about the least is risked.
Avoidance::Slowed Avoidance::slowedFor(const ContactRisk& risk, const Point& velocity_level_m_s, const Point& ahead,
                                       double intended_m_s, double latency_s) const {
  if (!risk.anybody()) return {intended_m_s, 0.0};
  constexpr int kSpeeds = 5;
  std::array<Slowed, kSpeeds> options;
  double least = 1.0;
  const int first = intended_m_s > 0.0 ? 0 : kSpeeds - 1;
  for (int i = first; i < kSpeeds; ++i) {
    const double speed_m_s = intended_m_s * (kSpeeds - 1 - i) / (kSpeeds - 1);
    const auto course =
        courseOf(velocity_level_m_s, speed_m_s * ahead, kAlways_s, latency_s, config_.deceleration_m_s2);
    options.at(i) = {speed_m_s, risk.of(course)};
    least = std::min(least, options.at(i).contact);
  }
  return *std::find_if(options.begin() + first, options.end(),
                       [&](const Slowed& one) { return one.contact <= least + kWorthSlowing; });
}

/// `least`: the probability on the best course. Where another one is better than standing, it is flown.
std::string Avoidance::whyNothingIsFree(const AvoidanceInput& input, const ContactRisk& risk, double least,
                                        double latency_s) const {
  if (least < kNothingFree) return {};
  const double standing =
      risk.of(courseOf(input.velocity_level_m_s, Point::Zero(), 0.0, latency_s, config_.deceleration_m_s2));
  if (standing > least + kWorthLeaving) return {};
  return fmt::format("no course is free of people: met with a probability of {:.2f} within {:.0f} s", least, kAlways_s);
}

/// Turning is worth its errors in a retreat, and while somebody walks about, also where that person is out of sight for
/// a while.
void Avoidance::look(const AvoidanceInput& input, const std::vector<Threat>& threats, std::vector<NearPerson> people,
                     AvoidanceDecision& decision) {
  constexpr double kAbout_s = 10.0;
  if (!people.empty()) people_seen_ = input.stamp;
  for (const Threat& threat : threats)
    if (threat.dangerous) people.push_back({threat.center_m, threat.velocity_m_s, threat.radius_m, 0.0});
  const Point& course_level_m_s = retreating_ ? last_retreat_level_ : input.wanted_level_m_s;
  const double turn_rad =
      lookout_.turn_rad({input.stamp, input.T_map_level, input.clearance, people, course_level_m_s});
  const bool about = people_seen_ && (input.stamp - *people_seen_).seconds() < kAbout_s;
  if (about || retreating_) decision.turn_rad = turn_rad;
}

RetreatChoice Avoidance::retreat(const AvoidanceInput& input, const Points& points, const std::vector<Threat>& threats,
                                 const std::vector<NearPerson>& people, const ContactRisk& risk,
                                 double latency_s) const {
  const bool danger = std::ranges::any_of(threats, &Threat::dangerous);
  if (!danger && !risk.anybody()) return {};
  // Where a person is seen now is free a moment later.
  Points standing;
  for (const Point& p : points)
    if (std::ranges::none_of(
            people, [&](const NearPerson& one) { return (one.place_m - p).norm() <= one.radius_m + kSameBody_m; }))
      standing.push_back(p);
  const RetreatInput retreat{input.velocity_level_m_s, standing,        threats,   last_retreat_level_,
                             input.T_map_level,        input.clearance, latency_s, &risk};
  switch (config_.retreat_rule) {
    case RetreatRule::kOpposite:
      return {oppositeVelocity(config_, hull_radius_m_, retreat), 0.0};
    case RetreatRule::kPotentialField:
      return {potentialFieldVelocity(config_, hull_radius_m_, retreat), 0.0};
    case RetreatRule::kClearCourse:
      break;
  }
  return retreatChoice(config_, hull_radius_m_, retreat);
}

}  // namespace swiftlet::planning
