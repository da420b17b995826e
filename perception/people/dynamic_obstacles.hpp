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

/// The end points of a scan, in order of bearing, and where it was taken; NaN for beams that tell nothing.
struct SeenPoints {
  Eigen::Vector2d from_map_m = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2f> points_map_m;
  std::vector<float> above_body_m;  ///< The height of each point.
};

/// Detects and tracks dynamic obstacles. Not thread-safe.
class DynamicObstacles {
 public:
  struct Config {
    double explained_within_m = 0.20;
    double cluster_gap_m = 0.25;
    int min_points = 3;
    double max_radius_m = 0.6;
    double assumed_depth_m = 0.10;
    double time_to_live_s = 2.0;
    double refuted_after_s = 0.2;
    double max_speed_m_s = 2.5;
    double moved_m = 0.25;
    double moved_within_s = 1.0;
    double followed_s = 0.15;
    double followed_share = 0.5;
    double reaches_m = -0.02;
    double smoothing_s = 0.15;
    double keep_out_m = 0.25;
    double max_range_m = 6.0;
    double background_age_s = 2.0;

    void describe(common::config::Fields& fields);
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
