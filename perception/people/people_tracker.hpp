// Tracks people around the vehicle from its scans and its own map: end points that an earlier map does not explain are
// tracked.
//
//   scan, pose in the map --> points in the hull's height band --> compared with the earlier map --> DynamicObstacles
//
// The result serves matching (points on moving people would bias a match), the map (which shows what stands),
// avoidance, and the planner's costs.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "common/disc.hpp"
#include "common/dynamic_obstacle.hpp"
#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/people/background_map.hpp"
#include "perception/people/dynamic_obstacles.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// The heights above and below the body that the map covers. Points at other heights cannot be compared with it.
struct HeightBand {
  double above_body_m = 0.25;
  double below_body_m = 0.25;
};

/// Not thread-safe. Deterministic.
class PeopleTracker {
 public:
  explicit PeopleTracker(const HeightBand& band) : band_(band) {}

  /// Takes in a scan at its pose in the map. `grid` is the map that includes this scan. When `T_map_odom` jumps, the
  /// whole map was corrected, and the history of the background restarts. `given` is part of the background, too.
  /// `below_map_m`: how much lower than the height of the map the body is.
  void update(const ProjectedScan& scan, const common::Pose2& T_map_body, const common::Pose2& T_map_odom,
              std::shared_ptr<const common::OccupancyGrid> grid,
              const std::optional<GivenBackground>& given = std::nullopt, double below_map_m = 0.0);

  /// The current obstacles, each as at its last sighting.
  const std::vector<common::DynamicObstacle>& obstacles() const { return obstacles_.obstacles(); }
  /// Of the newest scan: its end points in the height band, NaN at other heights.
  const SeenPoints& seen() const { return seen_; }
  /// Whether any obstacle is moving now.
  bool anyMoves() const { return obstacles_.anyMoves(); }
  /// The obstacles seen just before `stamp`, predicted to it. Each disc covers the whole outline of a person.
  std::vector<common::Disc> expectedAt(common::Time stamp) const;
  /// Those of them who walk.
  std::vector<common::Disc> walkersAt(common::Time stamp) const;
  /// The obstacles that move or have moved since they are tracked, also while they stand or are not seen. They are
  /// predicted to `stamp`, with room for what they may do meanwhile.
  std::vector<common::Disc> movingAt(common::Time stamp) const;
  /// Discs for the cost map: where the obstacles are and will soon be.
  std::vector<common::Disc> discs(common::Time now) const { return obstacles_.discs(now); }

 private:
  std::vector<common::Disc> justSeen(common::Time stamp, bool walkers_only) const;

  HeightBand band_;
  BackgroundMap background_{common::Duration::fromSeconds(DynamicObstacles::kBackgroundAge_s)};
  common::Pose2 T_map_odom_;
  SeenPoints seen_;
  DynamicObstacles obstacles_;
  std::set<int> moved_;  ///< Of the obstacles, those that have moved.
};

/// Marks the end points on people (ProjectedScan::moves).
void markPeople(std::span<const common::Disc> people, const common::Pose2& T_map_body, ProjectedScan& scan);

/// The scan for the map: a beam that ends on somebody who walks says only that the way there is free. Drawn as
/// occupied, each walker would leave a trace for seconds, which explains the next one who walks there and closes the
/// way behind the first (Haehnel, Triebel, Burgard, Thrun: "Map building with mobile robots in dynamic environments",
/// 2003).
ProjectedScan withoutWalkers(std::span<const common::Disc> walkers, const common::Pose2& T_map_body,
                             const ProjectedScan& scan);

/// The scan without its end points on people, whose motion would bias a match. If too few points would remain to match,
/// the whole scan. Beams without return and mirror points stay.
ProjectedScan withoutPeople(std::span<const common::Disc> people, const common::Pose2& T_map_body, ProjectedScan scan);

}  // namespace swiftlet::perception
