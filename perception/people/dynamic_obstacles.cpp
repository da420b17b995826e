#include "perception/people/dynamic_obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "common/occupied_near.hpp"

namespace swiftlet::perception {
namespace {

using common::CellIndex;
using common::Disc;
using common::DynamicObstacle;
using Point = Eigen::Vector2d;

/// Unexplained end points nearer to each other than this belong together.
constexpr double kClusterGap_m = 0.25;
/// A cluster of fewer points is taken for noise.
constexpr int kMinPoints = 3;
/// A larger cluster is a part of the building that was not in view before.
constexpr double kMaxRadius_m = 0.6;
/// The laser sees the near side of a body, whose centre is assumed this much behind it.
constexpr double kAssumedDepth_m = 0.10;
/// An obstacle that is no longer seen is kept for this long; one that moves for longer: who walks behind the vehicle or
/// a pillar has not gone, and comes out again.
constexpr double kTimeToLive_s = 2.0, kWalkerToLive_s = 4.0;
/// An obstacle that is not seen for this long where beams pass is gone.
constexpr double kRefutedAfter_s = 0.2;
/// Nothing is assumed to move faster than this.
constexpr double kMaxSpeed_m_s = 2.5;
/// Time constant of the filter on position and velocity.
constexpr double kSmoothing_s = 0.15;
/// An obstacle is moving that has come this far in this time; if it has not, it is standing. It must have been followed
/// for kFollowed_s and seen in this share of the scans: furniture under a tilting laser comes and goes (measured:
/// docs/decisions/grid_map.md#007).
constexpr double kMoved_m = 0.25, kMovedWithin_s = 1.0, kFollowed_s = 0.15, kFollowedShare = 0.5;
/// An obstacle that was never seen this high above the body while it is kept does not count as moving: a dipping laser
/// meets the top of a table now nearer, now farther (measured: docs/decisions/grid_map.md#072). The height of a beam is
/// known to a share of its range: 1 deg of the attitude, as in perception/slam2d/sliced_map.
constexpr double kReaches_m = -0.02, kHeightShare = 0.02;

/// Whether a point lies in space that the background knows as free, with nothing occupied or unknown within `cells`.
bool unexplained(const common::OccupancyGrid& background, const Point& point_m, int cells) {
  const CellIndex center = background.cellAt(point_m);
  for (int dy = -cells; dy <= cells; ++dy) {
    for (int dx = -cells; dx <= cells; ++dx) {
      if (dx * dx + dy * dy > cells * cells) continue;
      if (!common::occupancy::isFree(background.at({center.x + dx, center.y + dy}))) return false;
    }
  }
  return true;
}

/// Whether a point lies where nothing was occupied near, and its beam passes a place that was occupied.
bool revealed(const common::OccupancyGrid& background, const Point& point_m, const Point& sensor_m, int cells) {
  // In the age of the background a person walks this far at most.
  constexpr double kGone_m = 1.5;
  if (common::occupiedNear(background, background.cellAt(point_m), cells)) return false;
  const Point towards = (sensor_m - point_m).normalized();
  for (double back_m = 0.0; back_m <= kGone_m; back_m += background.resolution_m())
    if (common::occupancy::isOccupied(background.at(background.cellAt(point_m + back_m * towards)))) return true;
  return false;
}

bool isGiven(const GivenBackground* given, const Point& point_map_m, double within_m) {
  if (given == nullptr) return false;
  const common::OccupancyGrid& grid = *given->grid;
  const int cells = static_cast<int>(std::lround(within_m / grid.resolution_m()));
  return common::occupiedNear(grid, grid.cellAt(given->T_grid_map * point_map_m), cells);
}

/// What the beams beside a cluster of end points show, in order of bearing.
enum class Beside {
  kBehind,   ///< They end well behind it, or return nothing: it ends there.
  kJoined,   ///< A surface of which the cluster may be a part.
  kNothing,  ///< No beams: the edge of the field of view.
};

/// `edge` is the cluster's first or last point, and `step` leads away from it. The nearest beams may be split between
/// both surfaces.
Beside beside(std::span<const Eigen::Vector2f> points_map_m, std::size_t edge, std::ptrdiff_t step,
              const Point& sensor_map_m) {
  constexpr double kBehind_m = 0.3, kApart_m = 0.3;  // More than the depth of a body: another surface.
  constexpr std::ptrdiff_t kSplit = 3;
  const auto range_m = [&](std::ptrdiff_t i) { return (points_map_m[i].cast<double>() - sensor_map_m).norm(); };
  const auto at = static_cast<std::ptrdiff_t>(edge), count = static_cast<std::ptrdiff_t>(points_map_m.size());
  for (std::ptrdiff_t k = 1; k <= kSplit; ++k) {
    const std::ptrdiff_t next = at + k * step;
    if (next < 0 || next >= count) return k > 1 ? Beside::kJoined : Beside::kNothing;
    if (!points_map_m[next].allFinite() || range_m(next) > range_m(at) + kBehind_m) return Beside::kBehind;
    // The beams between returned nothing.
    if (k == 1 && (points_map_m[next] - points_map_m[at]).norm() > kApart_m) return Beside::kBehind;
  }
  return Beside::kJoined;
}

/// Whether several beams pass near the middle of the obstacle's predicted place and end well behind it.
bool violatesFreeSpace(const DynamicObstacle& obstacle, double age_s, std::span<const Eigen::Vector2f> points_map_m,
                       const Point& sensor_map_m) {
  // One beam may slip past an edge. 0.2 m is the depth of a person's body behind the outline that the laser sees.
  constexpr int kBeams = 2;
  constexpr double kBehind_m = 0.2;
  const Point to = obstacle.center_map_m + obstacle.velocity_map_m_s * age_s - sensor_map_m;
  int through = 0;
  for (const Eigen::Vector2f& point : points_map_m) {
    const Point beam = point.cast<double>() - sensor_map_m;
    const double length_m = beam.norm();
    if (!(length_m > to.norm() + obstacle.radius_m + kBehind_m) || beam.dot(to) <= 0.0) continue;
    const double aside_m = std::abs(beam.x() * to.y() - beam.y() * to.x()) / length_m;
    if (aside_m < 0.5 * obstacle.radius_m && ++through >= kBeams) return true;
  }
  return false;
}

}  // namespace

std::vector<DynamicObstacles::Cluster> DynamicObstacles::cluster(const SeenPoints& scan,
                                                                 const common::OccupancyGrid& background,
                                                                 const GivenBackground* given) {
  const std::vector<Eigen::Vector2f>& points_map_m = scan.points_map_m;
  const Point& sensor_map_m = scan.from_map_m;
  const int cells = static_cast<int>(std::lround(kExplainedWithin_m / background.resolution_m()));
  std::vector<Cluster> clusters;
  std::vector<Point> members;
  std::size_t first = 0, last = 0;
  float top_m = 0.0F;
  bool is_revealed = false;
  // A wall that is not where the map has it, because the position is wrong, joins other walls or leaves the field of
  // view; a person ends at least at one side.
  const auto standsAlone = [&] {
    const Beside before = beside(points_map_m, first, -1, sensor_map_m);
    const Beside after = beside(points_map_m, last, 1, sensor_map_m);
    const int ends = (before == Beside::kBehind) + (after == Beside::kBehind);
    if (is_revealed) return ends == 2;
    return ends > 0 || (before == Beside::kNothing && after == Beside::kNothing);
  };
  const auto close = [&] {
    if (static_cast<int>(members.size()) >= kMinPoints &&
        (members.back() - members.front()).norm() <= 2.0 * kMaxRadius_m && standsAlone()) {
      Point mean = Point::Zero();
      for (const Point& p : members) mean += p / static_cast<double>(members.size());
      double extent_m = 0.0;
      for (const Point& p : members) extent_m = std::max(extent_m, (p - mean).norm());
      const Point away = mean - sensor_map_m;
      const Point center = away.norm() > 1e-6 ? Point(mean + away.normalized() * kAssumedDepth_m) : mean;
      clusters.push_back({center, std::clamp(extent_m, kAssumedDepth_m, kMaxRadius_m), top_m});
    }
    members.clear();
    is_revealed = false;
  };
  for (std::size_t i = 0; i < points_map_m.size(); ++i) {
    if (!points_map_m[i].allFinite()) continue;
    const Point p = points_map_m[i].cast<double>();
    if ((p - sensor_map_m).norm() > kMaxRange_m) continue;
    const bool is_free = unexplained(background, p, cells);
    if (!is_free && !revealed(background, p, sensor_map_m, cells)) continue;
    if (isGiven(given, p, kExplainedWithin_m)) continue;
    if (!members.empty() && (p - members.back()).norm() > kClusterGap_m) close();
    top_m = members.empty() ? scan.above_body_m[i] : std::max(top_m, scan.above_body_m[i]);
    if (members.empty()) first = i;
    last = i;
    is_revealed = is_revealed || !is_free;
    members.push_back(p);
  }
  close();
  return clusters;
}

DynamicObstacles::Track* DynamicObstacles::nearestFree(const Cluster& seen, common::Time stamp, std::span<Track> tracks,
                                                       const std::vector<bool>& taken) {
  Track* nearest = nullptr;
  double nearest_m = 0.0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const DynamicObstacle& o = tracks[i].obstacle;
    const double dt_s = (stamp - o.last_seen).seconds();
    const Point expected = o.center_map_m + o.velocity_map_m_s * dt_s;
    const double off_m = (expected - seen.center_map_m).norm();
    const double gate_m = 0.3 + kMaxSpeed_m_s * std::min(dt_s, 0.3);
    if (taken[i] || off_m > gate_m || (nearest != nullptr && off_m >= nearest_m)) continue;
    nearest = &tracks[i];
    nearest_m = off_m;
  }
  return nearest;
}

void DynamicObstacles::update(common::Time stamp, const SeenPoints& scan, const common::OccupancyGrid& background,
                              const GivenBackground* given) {
  const auto reached = [&](const Cluster& seen) {
    const double unsure_m = kHeightShare * (seen.center_map_m - scan.from_map_m).norm();
    return seen.top_above_body_m >= kReaches_m - unsure_m ? std::optional(stamp) : std::nullopt;
  };
  for (Track& track : tracks_) ++track.scans;
  const std::size_t known = tracks_.size();
  std::vector<bool> taken(known, false);
  std::vector<Track> fresh;
  for (const Cluster& seen : cluster(scan, background, given)) {
    Track* const track = nearestFree(seen, stamp, tracks_, taken);
    if (track == nullptr) {
      fresh.push_back({{next_id_++, seen.center_map_m, seen.radius_m, Point::Zero(), false, stamp},
                       seen.center_map_m,
                       stamp,
                       0,
                       0,
                       reached(seen)});
      continue;
    }
    taken[static_cast<std::size_t>(track - tracks_.data())] = true;
    if (const auto now = reached(seen)) track->reached = now;
    correct(*track, seen, stamp);
  }
  tracks_.insert(tracks_.end(), fresh.begin(), fresh.end());
  std::erase_if(tracks_, [&](const Track& track) {
    const double age_s = (stamp - track.obstacle.last_seen).seconds();
    return age_s > (track.obstacle.moving ? kWalkerToLive_s : kTimeToLive_s) ||
           (age_s > kRefutedAfter_s && violatesFreeSpace(track.obstacle, age_s, scan.points_map_m, scan.from_map_m));
  });
  obstacles_.clear();
  for (const Track& track : tracks_) obstacles_.push_back(track.obstacle);
}

/// The critically damped alpha-beta filter with the time constant `kSmoothing_s`.
void DynamicObstacles::correct(Track& track, const Cluster& seen, common::Time stamp) {
  DynamicObstacle& o = track.obstacle;
  const double dt_s = (stamp - o.last_seen).seconds();
  if (dt_s <= 0.0) return;
  const Point expected = o.center_map_m + o.velocity_map_m_s * dt_s, error = seen.center_map_m - expected;
  const double forget = std::exp(-dt_s / kSmoothing_s);
  o.center_map_m = expected + (1.0 - forget * forget) * error;
  o.velocity_map_m_s += error * ((1.0 - forget) * (1.0 - forget) / dt_s);
  const double speed_m_s = o.velocity_map_m_s.norm();
  if (speed_m_s > kMaxSpeed_m_s) o.velocity_map_m_s *= kMaxSpeed_m_s / speed_m_s;
  o.radius_m = std::max(seen.radius_m, 0.9 * o.radius_m);
  o.last_seen = stamp;
  ++track.sightings;
  judgeMotion(track);
}

/// Decides whether an obstacle is moving. An object that comes into view bit by bit seems to move for a moment, so
/// motion counts only when it lasts.
void DynamicObstacles::judgeMotion(Track& track) {
  DynamicObstacle& o = track.obstacle;
  const double since_s = (o.last_seen - track.anchor_stamp).seconds();
  const bool moved = (o.center_map_m - track.anchor_map_m).norm() >= kMoved_m;
  const bool followed = since_s >= kFollowed_s && track.sightings >= kFollowedShare * track.scans;
  if (!(moved && followed) && since_s < kMovedWithin_s) return;
  // A moving obstacle may have been hidden meanwhile; it remains moving.
  o.moving = track.reached && moved && (followed || o.moving);
  track.anchor_map_m = o.center_map_m;
  track.anchor_stamp = o.last_seen;
  track.scans = track.sightings = 0;
}

bool DynamicObstacles::anyMoves() const {
  return std::any_of(obstacles_.begin(), obstacles_.end(), [](const DynamicObstacle& o) { return o.moving; });
}

std::vector<Disc> DynamicObstacles::discs(common::Time now, double horizon_s) const {
  std::vector<Disc> result;
  for (const DynamicObstacle& o : obstacles_) {
    const double age_s = (now - o.last_seen).seconds();
    if (age_s > kTimeToLive_s) continue;
    const Point velocity_map_m_s = o.believedVelocity_map_m_s();
    const double step_s = std::max(0.1, o.radius_m / std::max(0.1, velocity_map_m_s.norm()));
    for (double t = 0.0; t <= horizon_s; t += step_s)
      result.push_back({o.center_map_m + velocity_map_m_s * (std::min(age_s, 1.0) + t), o.radius_m + kKeepOut_m});
  }
  return result;
}

}  // namespace swiftlet::perception
