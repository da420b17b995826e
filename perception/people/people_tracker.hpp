// People around the vehicle, from its scans and its own map: what an earlier map does not explain is followed.
//
//   scan, pose in the map --> points in the hull's height band --> against the map of a while ago --> DynamicObstacles
//
// The result is an input of matching (people carry a match along), of avoidance and of the planner's costs.
#pragma once

#include <memory>
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

/// Heights over and under the body of which the map speaks: nothing outside can be told from the background.
struct HeightBand {
  double above_body_m = 0.25;
  double below_body_m = 0.25;
};

/// One thread; deterministic.
class PeopleTracker {
 public:
  using Config = DynamicObstacles::Config;
  PeopleTracker(const Config& config, const HeightBand& band);

  /// Takes a scan in at its pose in the map. `grid` is the map with this scan, `T_map_odom` its place: after a
  /// correction of the map as a whole the background begins anew.
  void update(const ProjectedScan& scan, const common::Pose2& T_map_body, const common::Pose2& T_map_odom,
              std::shared_ptr<const common::OccupancyGrid> grid);

  /// Those still believed in, at their last sighting.
  const std::vector<common::DynamicObstacle>& obstacles() const { return obstacles_.obstacles(); }
  /// Whether somebody has left the place where he was seen first.
  bool anyMoves() const { return obstacles_.anyMoves(); }
  /// Those seen just before `stamp`, predicted to it; each disc covers the whole outline.
  std::vector<common::Disc> expectedAt(common::Time stamp) const;
  /// Where they are and will soon be, for the cost map.
  std::vector<common::Disc> discs(common::Time now) const { return obstacles_.discs(now); }

 private:
  HeightBand band_;
  BackgroundMap background_;
  common::Pose2 T_map_odom_;
  DynamicObstacles obstacles_;
};

/// The scan without its end points on people, whose motion would bias a match; the whole scan where too few points
/// would remain to match with. Beams without return and the mirror stay.
ProjectedScan withoutPeople(std::span<const common::Disc> people, const common::Pose2& T_map_body, ProjectedScan scan);

}  // namespace swiftlet::perception
