// What moves: end points that the known map does not explain (background subtraction, Grzonka 2012, section IV-E),
// clustered and followed.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// The map as it was a while ago. A live map soon holds the person who walks through it; the map of some seconds ago
/// does not.
class BackgroundMap {
 public:
  explicit BackgroundMap(common::Duration age) : age_(age) {}
  /// Call at each new map; cheap, tiles are shared. Call restart() first when the map was corrected as a whole.
  void add(common::Time stamp, std::shared_ptr<const common::OccupancyGrid> grid);
  void restart() { history_.clear(); }
  /// The newest map that is at least `age` old, else the oldest; null when none was added.
  std::shared_ptr<const common::OccupancyGrid> at(common::Time now);

 private:
  struct Entry {
    common::Time stamp;
    std::shared_ptr<const common::OccupancyGrid> grid;
  };
  common::Duration age_;
  std::deque<Entry> history_;
};

/// A cluster of unexplained end points, followed over scans, in the `map` frame.
struct DynamicObstacle {
  int id = 0;
  Eigen::Vector2d center_map_m = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
  Eigen::Vector2d velocity_map_m_s = Eigen::Vector2d::Zero();
  /// It has left a place where it was seen; the velocity of one that has not is not to be believed.
  bool moving = false;
  Eigen::Vector2d anchor_map_m = Eigen::Vector2d::Zero();  ///< That place,
  common::Time anchor_stamp;                               ///< and when it was seen there.
  int scans = 0;                                           ///< Since then,
  int sightings = 0;                                       ///< and in how many of them it was seen.
  common::Time last_seen;

  Eigen::Vector2d believedVelocity_map_m_s() const { return moving ? velocity_map_m_s : Eigen::Vector2d::Zero(); }
};

/// Finds and follows them. One thread.
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
    double smoothing_s = 0.15;
    double keep_out_m = 0.25;
    double max_range_m = 6.0;
    double background_age_s = 2.0;

    void describe(common::config::Fields& fields);
  };

  explicit DynamicObstacles(const Config& config);

  /// `points_map_m`: end points of one scan in order of bearing, seen from `sensor_map_m`. Points that are not finite
  /// are left out. A point is unexplained when it lies in space the background knows as free, with nothing occupied
  /// near; what lies in unknown space is new, not dynamic.
  void update(common::Time stamp, std::span<const Eigen::Vector2f> points_map_m, const Eigen::Vector2d& sensor_map_m,
              const common::OccupancyGrid& background);

  /// Those still believed in, by id.
  const std::vector<DynamicObstacle>& obstacles() const { return obstacles_; }
  /// Whether any of them is on its way somewhere.
  bool anyMoves() const;
  /// For the cost map: where each is, and where it will be within `horizon_s` as it moves now.
  std::vector<Disc> discs(common::Time now, double horizon_s = 0.5) const;

 private:
  struct Cluster {
    Eigen::Vector2d center_map_m;
    double radius_m;
  };
  std::vector<Cluster> cluster(std::span<const Eigen::Vector2f> points_map_m, const Eigen::Vector2d& sensor_map_m,
                               const common::OccupancyGrid& background) const;
  void judgeMotion(DynamicObstacle& obstacle) const;

  Config config_;
  int next_id_ = 1;
  std::vector<DynamicObstacle> obstacles_;
};

}  // namespace swiftlet::planning
