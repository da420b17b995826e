#include "planning/avoidance/retreat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;
using Points = std::vector<Point>;

constexpr double kUnreached = std::numeric_limits<double>::infinity();
constexpr double kStep_s = ContactRisk::kStep_s;
constexpr int kSteps = ContactRisk::kSteps;
/// Motion of people is extrapolated for at most this time. A contact sooner than `kTooSoon_s` cannot be changed any
/// more.
constexpr double kForesight_s = 1.5, kTooSoon_s = 0.3;
/// The courses of a retreat (docs/decisions/avoidance.md#004).
constexpr int kDirections = 36;
constexpr std::array<double, 3> kShareOfSpeed{0.25, 0.5, 1.0};
constexpr std::array<double, 3> kGoing_s{0.2, 0.5, 0.9};
/// Preferences that are weighed against the gap, in metres of gap: flying straight away, keeping the direction, flying
/// slowly, and moving at all.
constexpr double kAway_m = 0.06, kSame_m = 0.05, kSlow_m = 0.06, kWorth_m = 0.02;
/// A contact that is certain counts as much as this gap.
constexpr double kContact_m = 3.0;
/// While people walk about, room to the sides counts up to the width of hull and person and as much again.
constexpr double kOpen_m = 1.1, kOpenShare = 0.2;
/// Returns denser than a cell of the shipped map are left out.
constexpr double kThinned_m = 0.05;

using Course = ContactRisk::Course;

struct Prospect {
  double seen_m;     ///< Least distance of the centre to a return.
  double mapped_m;   ///< Least distance of the centre to a mapped obstacle.
  double gap_m;      ///< Least gap to any person during the prediction.
  double end_gap_m;  ///< Gap to the nearest person at the end of the prediction.
  double room_m;     ///< Distance of the centre to the nearest static obstacle at the end, capped at the wanted margin.
  double open_m;     ///< The same, capped at kOpen_m: beside a wall fewer ways lead on.

  double contact;  ///< Probability that a person is met.

  double worth_m() const { return gap_m + 0.5 * end_gap_m + room_m + kOpenShare * open_m - kContact_m * contact; }
};

class Retreat {
 public:
  Retreat(const AvoidanceConfig& config, double hull_radius_m, const RetreatInput& input)
      : config_(config), hull_radius_m_(hull_radius_m), input_(input) {
    // The latency, the longest flight and the time to brake to rest.
    constexpr double kLongest_s = 2.0;
    const double reach_m = input.velocity_level_m_s.norm() * input.latency_s + kRetreatSpeed_m_s * kLongest_s;
    for (const Point& p : input.points_level_m) {
      const bool far = p.norm() > reach_m + safe_m();
      if (!far && (near_.empty() || (p - near_.back()).norm() > kThinned_m)) near_.push_back(p);
    }
    for (const Threat& threat : input.threats)
      if (threat.dangerous) away_ += awayFrom(threat);
    if (away_.norm() > 1e-6) away_.normalize();
    if (input.last_level_m_s.norm() > 1e-6) last_ = input.last_level_m_s.normalized();
  }

  RetreatChoice best() const {
    const Prospect stop = prospectOf(courseAt(Point::Zero(), 0.0));
    double best_score = -kUnreached;
    RetreatChoice best{Point::Zero(), stop.contact};
    for (int i = 0; i < kDirections; ++i) {
      const double angle_rad = 2.0 * std::numbers::pi * i / kDirections;
      const Point direction(std::cos(angle_rad), std::sin(angle_rad));
      for (const double share : kShareOfSpeed) {
        const Point velocity = share * kRetreatSpeed_m_s * direction;
        for (const double going_s : kGoing_s) {
          const Course course = courseAt(velocity, going_s);
          const Prospect prospect = prospectOf(course);
          const bool clear = prospect.seen_m >= std::min(stop.seen_m, safe_m()) &&
                             prospect.mapped_m >= std::min(stop.mapped_m, safe_m());
          if (!clear || prospect.worth_m() < stop.worth_m() + kWorth_m) continue;
          const double score =
              prospect.worth_m() + kAway_m * direction.dot(away_) + kSame_m * direction.dot(last_) - kSlow_m * share;
          if (score <= best_score) continue;
          best_score = score;
          best = {velocity, prospect.contact};
        }
      }
    }
    return best;
  }

 private:
  /// Prefers a course across the path of a passing person to one along it, and a course straight away from a person who
  /// comes straight on.
  static Point awayFrom(const Threat& threat) {
    // Two half widths of a person and the vehicle: a person whose line passes farther off does not meet the vehicle.
    constexpr double kPasses_m = 0.5;
    Point straight = -threat.center_m.normalized();
    if (threat.velocity_m_s.isZero()) return straight;
    const Point along = threat.velocity_m_s.normalized();
    const Point aside = -threat.center_m + threat.center_m.dot(along) * along;
    const double passing = std::min(1.0, aside.norm() / kPasses_m);
    return passing * aside.normalized() + (1.0 - passing) * straight;
  }

  double safe_m() const { return hull_radius_m_ + config_.retreat_margin_m; }

  Course courseAt(const Point& wanted_m_s, double going_s) const {
    return courseOf(input_.velocity_level_m_s, wanted_m_s, going_s, input_.latency_s, kRetreatAcceleration_m_s2);
  }

  Prospect prospectOf(const Course& course) const {
    // A gap beyond the one that ends a retreat is not worth moving for.
    const double enough_m =
        config_.release_factor * std::max(config_.retreat_distance_m, config_.contact_gap_m) + 2.0 * kWorth_m;
    double seen_m = kUnreached, mapped_m = kUnreached, gap_m = enough_m, end_gap_m = enough_m, room_m = 0.0;
    double time_s = 0.0, to_seen_m = 0.0, to_mapped_m = 0.0;
    const Point* before = nullptr;
    for (const Point& place : course) {
      if (before == nullptr || *before != place) {  // At rest nothing that stands comes nearer.
        to_seen_m = toSeen_m(place);
        to_mapped_m = toMapped_m(place);
      }
      before = &place;
      seen_m = std::min(seen_m, to_seen_m);
      mapped_m = std::min(mapped_m, to_mapped_m);
      room_m = std::min({to_seen_m, to_mapped_m, safe_m()});
      if (time_s >= kTooSoon_s && time_s <= kForesight_s) {
        end_gap_m = enough_m;
        for (const Threat& threat : input_.threats)
          end_gap_m = std::min(end_gap_m, threat.gapTo(hull_radius_m_, place, time_s));
        gap_m = std::min(gap_m, end_gap_m);
      }
      time_s += kStep_s;
    }
    const bool anybody = input_.people != nullptr && input_.people->anybody();
    const double open_m = anybody ? std::min({to_seen_m, to_mapped_m, kOpen_m}) : 0.0;
    return {
        seen_m, mapped_m, gap_m, end_gap_m, room_m, open_m, input_.people == nullptr ? 0.0 : input_.people->of(course)};
  }

  double toSeen_m(const Point& place) const {
    double squared = kUnreached;
    for (const Point& p : near_) squared = std::min(squared, (p - place).squaredNorm());
    return std::sqrt(squared);
  }

  double toMapped_m(const Point& place) const {
    if (input_.clearance == nullptr) return kUnreached;
    const Point place_map_m = input_.T_map_level * place;
    const bool seen = input_.clearance->at_m(place_map_m, Against::kUnseen) > 0.0;
    return seen ? input_.clearance->at_m(place_map_m, Against::kObstacles) : 0.0;
  }

  const AvoidanceConfig& config_;
  double hull_radius_m_;
  const RetreatInput& input_;
  Points near_;
  Point away_ = Point::Zero(), last_ = Point::Zero();
};

}  // namespace

ContactRisk::Course courseOf(const Eigen::Vector2d& velocity_now_m_s, const Eigen::Vector2d& wanted_m_s, double going_s,
                             double latency_s, double acceleration_m_s2) {
  const double most_m_s = acceleration_m_s2 * kStep_s;
  Course course;
  Point place = Point::Zero(), velocity = velocity_now_m_s;
  for (int i = 0; i <= kSteps; ++i) {
    course[static_cast<std::size_t>(i)] = place;
    const double since_s = i * kStep_s - latency_s;
    if (since_s >= 0.0) {
      const Point change = (since_s < going_s ? wanted_m_s : Point::Zero()) - velocity;
      velocity = change.norm() > most_m_s ? Point(velocity + change.normalized() * most_m_s)
                                          : Point(since_s < going_s ? wanted_m_s : Point::Zero());
    }
    place += velocity * kStep_s;
  }
  return course;
}

RetreatChoice retreatChoice(const AvoidanceConfig& config, double hull_radius_m, const RetreatInput& input) {
  return Retreat(config, hull_radius_m, input).best();
}

}  // namespace swiftlet::planning
