#include "perception/people/people_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/possible_walks.hpp"

namespace swiftlet::perception {
namespace {

using common::Disc;
using common::Pose2;

/// When T_map_odom jumps by more, the whole map was corrected. Local corrections are millimetres, loop closures are
/// more.
constexpr double kCorrected_m = 0.05;
constexpr double kCorrected_rad = 0.01;  ///< 5 cm at a range of 5 m.

/// Obstacles with older sightings are not predicted. This is six scans at 40 Hz.
constexpr double kJustSeen_s = 0.15;
/// Margin for the part of a person's outline that was not seen.
constexpr double kAround_m = 0.20;

/// A beam shows that the way is free up to this far before where it ends on somebody who walks: the depth of a body.
constexpr float kBefore_m = 0.3F;

/// Least share of a scan's points that must remain when points on people are removed.
constexpr double kLeastShare = 0.4;

bool isOnAny(std::span<const Disc> people, const Pose2& T_map_body, const Eigen::Vector2f& point_level_m) {
  const Eigen::Vector2d point_map_m = T_map_body * Eigen::Vector2d(point_level_m.cast<double>());
  return std::any_of(people.begin(), people.end(), [&](const Disc& disc) { return disc.covers(point_map_m); });
}

}  // namespace

void PeopleTracker::update(const ProjectedScan& scan, const Pose2& T_map_body, const Pose2& T_map_odom,
                           std::shared_ptr<const common::OccupancyGrid> grid,
                           const std::optional<GivenBackground>& given, double below_map_m) {
  // Scans placed in the corrected map cannot be compared with the maps before the correction.
  const Pose2 jump = T_map_odom_.inverse() * T_map_odom;
  if (jump.position_m().norm() > kCorrected_m || std::abs(jump.yaw_rad) > kCorrected_rad) background_.restart();
  T_map_odom_ = T_map_odom;
  background_.add(scan.stamp, std::move(grid));

  const auto above_m = static_cast<float>(band_.above_body_m + below_map_m);
  const auto below_m = static_cast<float>(band_.below_body_m - below_map_m);
  constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
  seen_.from_map_m = T_map_body.position_m();
  seen_.above_body_m = scan.heights_level_m;
  seen_.points_map_m.clear();
  seen_.points_map_m.reserve(scan.points_level_m.size());
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    const bool in_band = scan.heights_level_m[i] <= above_m && scan.heights_level_m[i] >= -below_m;
    seen_.points_map_m.push_back(
        in_band ? Eigen::Vector2f((T_map_body * Eigen::Vector2d(scan.points_level_m[i].cast<double>())).cast<float>())
                : Eigen::Vector2f(kNowhere, kNowhere));
  }
  if (const auto background = background_.at(scan.stamp))
    obstacles_.update(scan.stamp, seen_, *background, given ? &*given : nullptr);
  std::set<int> moved;
  for (const common::DynamicObstacle& o : obstacles())
    if (o.moving || moved_.contains(o.id)) moved.insert(o.id);
  moved_ = std::move(moved);
}

std::vector<Disc> PeopleTracker::expectedAt(common::Time stamp) const { return justSeen(stamp, false); }

std::vector<Disc> PeopleTracker::walkersAt(common::Time stamp) const { return justSeen(stamp, true); }

std::vector<Disc> PeopleTracker::justSeen(common::Time stamp, bool walkers_only) const {
  std::vector<Disc> result;
  for (const common::DynamicObstacle& o : obstacles()) {
    const double age_s = (stamp - o.last_seen).seconds();
    if (age_s > kJustSeen_s || (walkers_only && o.believedVelocity_map_m_s().norm() < common::kStands_m_s)) continue;
    result.push_back({o.center_map_m + o.believedVelocity_map_m_s() * age_s, o.radius_m + kAround_m});
  }
  return result;
}

std::vector<Disc> PeopleTracker::movingAt(common::Time stamp) const {
  // The turns of a person out of sight are unknown, so the disc grows at this speed. The value is not measured: a disc
  // that is too large only keeps end points below the laser, near a person who has moved, out of the map.
  constexpr double kMayTurn_m_s = 0.3;
  std::vector<Disc> result;
  for (const common::DynamicObstacle& o : obstacles()) {
    if (!moved_.contains(o.id)) continue;
    const double age_s = std::max(0.0, (stamp - o.last_seen).seconds());
    result.push_back(
        {o.center_map_m + o.believedVelocity_map_m_s() * age_s, o.radius_m + 2.0 * kAround_m + kMayTurn_m_s * age_s});
  }
  return result;
}

void markPeople(std::span<const Disc> people, const Pose2& T_map_body, ProjectedScan& scan) {
  scan.moves.clear();
  if (people.empty()) return;
  for (const Eigen::Vector2f& point_m : scan.points_level_m) scan.moves.push_back(isOnAny(people, T_map_body, point_m));
}

ProjectedScan withoutWalkers(std::span<const Disc> walkers, const Pose2& T_map_body, const ProjectedScan& scan) {
  ProjectedScan drawn = scan;
  if (walkers.empty()) return drawn;
  drawn.points_level_m.clear();
  drawn.heights_level_m.clear();
  drawn.moves.clear();
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    const Eigen::Vector2f& end = scan.points_level_m[i];
    const float height_m = i < scan.heights_level_m.size() ? scan.heights_level_m[i] : 0.0F;
    if (!isOnAny(walkers, T_map_body, end)) {
      drawn.points_level_m.push_back(end);
      drawn.heights_level_m.push_back(height_m);
      if (!scan.moves.empty()) drawn.moves.push_back(scan.moves[i]);
      continue;
    }
    const float share = 1.0F - kBefore_m / std::max(kBefore_m, end.norm());
    drawn.misses_level_m.emplace_back(share * end.x(), share * end.y(),
                                      scan.laser_height_level_m + share * (height_m - scan.laser_height_level_m));
  }
  return drawn;
}

ProjectedScan withoutPeople(std::span<const Disc> people, const Pose2& T_map_body, ProjectedScan scan) {
  if (people.empty()) return scan;
  std::vector<Eigen::Vector2f> points_level_m;
  std::vector<float> heights_level_m;
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    if (isOnAny(people, T_map_body, scan.points_level_m[i])) continue;
    points_level_m.push_back(scan.points_level_m[i]);
    heights_level_m.push_back(scan.heights_level_m[i]);
  }
  if (static_cast<double>(points_level_m.size()) < kLeastShare * static_cast<double>(scan.points_level_m.size()))
    return scan;
  scan.points_level_m = std::move(points_level_m);
  scan.heights_level_m = std::move(heights_level_m);
  return scan;
}

}  // namespace swiftlet::perception
