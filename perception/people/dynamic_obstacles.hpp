// Detection and tracking of dynamic obstacles: end points that the known map does not explain (background subtraction,
// Grzonka 2012, section IV-E) are clustered, and the clusters are tracked.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/disc.hpp"
#include "common/dynamic_obstacle.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/people/background_map.hpp"
#include "perception/people/seen_points.hpp"

namespace swiftlet::perception {

/// Detects and tracks dynamic obstacles. Not thread-safe.
class DynamicObstacles {
 public:
  /// An end point this near to something mapped or unknown is explained.
  static constexpr double kExplainedWithin_m = 0.20;
  /// End points farther away are left out.
  static constexpr double kMaxRange_m = 6.0;
  /// Age of the map that explains end points.
  static constexpr double kBackgroundAge_s = 2.0;
  /// Added to the radius for the planner, so that it does not plan what makes the vehicle retreat.
  static constexpr double kKeepOut_m = 0.25;

  /// Takes in one scan. A point is unexplained when it lies in space that the background knows as free, with nothing
  /// occupied or unknown near. A point in unknown space is new, not dynamic, unless it is on a thing that stands by
  /// itself behind a place from which something has gone: a person who walks straight away from the laser.
  void update(common::Time stamp, const SeenPoints& scan, const common::OccupancyGrid& background,
              const GivenBackground* given = nullptr);

  /// The current obstacles, by id.
  const std::vector<common::DynamicObstacle>& obstacles() const { return obstacles_; }
  /// Whether any obstacle is moving now.
  bool anyMoves() const;
  /// Discs for the cost map: where each obstacle is, and where it will be within `horizon_s` at its present velocity.
  std::vector<common::Disc> discs(common::Time now, double horizon_s = 0.5) const;

 private:
  struct Cluster {
    Eigen::Vector2d center_map_m;
    double radius_m;
    double top_above_body_m;
  };
  static std::vector<Cluster> cluster(const SeenPoints& scan, const common::OccupancyGrid& background,
                                      const GivenBackground* given);
  /// An obstacle and the evidence for its motion.
  struct Track {
    common::DynamicObstacle obstacle;
    Eigen::Vector2d anchor_map_m = Eigen::Vector2d::Zero();  ///< The position its motion is measured from.
    common::Time anchor_stamp;                               ///< When it was there.
    int scans = 0;                                           ///< Scans since anchor_stamp.
    int sightings = 0;                                       ///< Scans since anchor_stamp that saw it.
    std::optional<common::Time> reached;                     ///< When it was last seen as high as a person reaches.
  };
  static Track* nearestFree(const Cluster& seen, common::Time stamp, std::span<Track> tracks,
                            const std::vector<bool>& taken);
  static void correct(Track& track, const Cluster& seen, common::Time stamp);
  static void judgeMotion(Track& track);

  int next_id_ = 1;
  std::vector<Track> tracks_;
  std::vector<common::DynamicObstacle> obstacles_;  ///< The obstacles of the tracks.
};

}  // namespace swiftlet::perception
