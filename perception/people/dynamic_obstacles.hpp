// Detection and tracking of dynamic obstacles: end points that the known map does not explain (background subtraction,
// Grzonka 2012, section IV-E) are clustered, and the clusters are tracked.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/disc.hpp"
#include "common/dynamic_obstacle.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/people/background_map.hpp"

namespace swiftlet::perception {

/// The end points of a scan, in order of bearing, and where it was taken; NaN for beams without information.
struct SeenPoints {
  Eigen::Vector2d from_map_m = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2f> points_map_m;
  std::vector<float> above_body_m;  ///< The height of each point.
};

/// Detects and tracks dynamic obstacles. Not thread-safe.
class DynamicObstacles {
 public:
  struct Config {
    static constexpr double explained_within_m =
        0.20;  ///< An end point this near to something mapped or unknown is explained.
    static constexpr double cluster_gap_m =
        0.25;                             ///< Unexplained end points nearer to each other than this belong together.
    static constexpr int min_points = 3;  ///< A cluster of fewer points is taken for noise.
    static constexpr double max_radius_m =
        0.6;  ///< A larger cluster is a part of the building that was not in view before.
    static constexpr double assumed_depth_m =
        0.10;  ///< The laser sees the near side of a body, whose centre is assumed this much behind it.
    static constexpr double time_to_live_s = 2.0;  ///< An obstacle that is no longer seen is kept for this long.
    static constexpr double refuted_after_s =
        0.2;  ///< An obstacle that is not seen for this long where beams pass is gone.
    static constexpr double max_speed_m_s = 2.5;  ///< Nothing is assumed to move faster than this.
    static constexpr double moved_m = 0.25;       ///< An obstacle that has come this far is moving.
    static constexpr double moved_within_s =
        1.0;  ///< An obstacle that has not come as far as moved_m in this time is standing.
    static constexpr double followed_s =
        0.15;  ///< An obstacle that was followed for a shorter time does not count as moving.
    static constexpr double followed_share = 0.5;  ///< An obstacle that was in a smaller share of the scans does not
                                                   ///< count as moving: furniture under a tilting laser comes and goes.
    static constexpr double reaches_m =
        -0.02;  ///< An obstacle that was never seen this high above the body while it is kept does not count as moving:
                ///< a dipping laser meets the top of a table now nearer, now farther.
    static constexpr double smoothing_s = 0.15;  ///< Time constant of the filter on position and velocity.
    static constexpr double keep_out_m =
        0.25;  ///< Added to the radius for the planner, so that it does not plan what makes the vehicle retreat.
    static constexpr double max_range_m = 6.0;       ///< End points farther away are left out.
    static constexpr double background_age_s = 2.0;  ///< Age of the map that explains end points.
  };

  explicit DynamicObstacles(const Config& config);

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
  std::vector<Cluster> cluster(const SeenPoints& scan, const common::OccupancyGrid& background,
                               const GivenBackground* given) const;
  /// An obstacle and the evidence for its motion.
  struct Track {
    common::DynamicObstacle obstacle;
    Eigen::Vector2d anchor_map_m = Eigen::Vector2d::Zero();  ///< The position its motion is measured from.
    common::Time anchor_stamp;                               ///< When it was there.
    int scans = 0;                                           ///< Scans since anchor_stamp.
    int sightings = 0;                                       ///< Scans since anchor_stamp that saw it.
    std::optional<common::Time> reached;                     ///< When it was last seen as high as `reaches_m`.
  };
  Track* nearestFree(const Cluster& seen, common::Time stamp, std::span<Track> tracks, const std::vector<bool>& taken);
  void correct(Track& track, const Cluster& seen, common::Time stamp) const;
  void judgeMotion(Track& track) const;

  Config config_;
  int next_id_ = 1;
  std::vector<Track> tracks_;
  std::vector<common::DynamicObstacle> obstacles_;  ///< The obstacles of the tracks.
};

}  // namespace swiftlet::perception
