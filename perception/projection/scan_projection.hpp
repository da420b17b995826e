// Deskewing and levelling of one sweep of the 2D laser: every beam is placed by the pose that the body had when the
// beam was fired, and projected to the gravity-levelled frame of one reference time (Grzonka 2009, eq. 1 and 2).
//
// The level frame has its origin at the body, x and y horizontal, and the yaw of the body, all at `stamp`, the middle
// of the sweep. At that time, errors of the motion used for deskewing have the least effect and cancel to first order.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::perception {

/// T_odom_body at any time within the sweep, interpolated or predicted. z is the height above the take-off floor.
using PoseAt = std::function<common::Pose3(common::Time)>;

/// An end point of a beam that the mirror deflects down; for the altitude filter.
struct MirrorPoint {
  float x_level_m = 0.0F;
  float y_level_m = 0.0F;
  float z_level_m = 0.0F;  ///< Relative to the body at `stamp`; negative below it.
  double belowBody_m() const { return -static_cast<double>(z_level_m); }
};

/// The number of beams with each result; the sum is the number of beams.
struct BeamCounts {
  int hits = 0;            ///< Ended on something that counts as a wall; in `points_level_m`.
  int no_returns = 0;      ///< No return: the range is infinite or beyond the laser's.
  int invalid = 0;         ///< NaN, negative, too short, on the vehicle itself, or a mixed pixel.
  int floor_hits = 0;      ///< Ended on the floor; not in `points_level_m`.
  int ceiling_hits = 0;    ///< Ended on the ceiling; not in `points_level_m`.
  int mirror = 0;          ///< Valid beams on the mirror; in `mirror`.
  int mirror_invalid = 0;  ///< Beams on the mirror without a valid range.
  bool operator==(const BeamCounts&) const = default;
};

/// One sweep in the level frame.
struct ProjectedScan {
  common::Time stamp;                           ///< The middle of the sweep.
  common::Pose3 T_odom_body;                    ///< At `stamp`, as predicted by `PoseAt`.
  float laser_height_level_m = 0.0F;            ///< Height of the laser, where the beams begin, relative to the body.
  std::vector<Eigen::Vector2f> points_level_m;  ///< End points, in beam order.
  std::vector<float> heights_level_m;           ///< Height of each end point relative to the body.
  /// Whether an end point is on something that moves, in the order of the end points; empty if nothing moves.
  std::vector<bool> moves;
  /// For each beam that ended on floor or ceiling, the point where it leaves the height band in which "free" means free
  /// for the body, or else its end. Everything from the body to there is free. The third coordinate is the height
  /// relative to the body.
  std::vector<Eigen::Vector3f> misses_level_m;
  /// The points of misses_level_m for beams without return, at most at the laser's greatest range. These beams say
  /// less, because a dark or slanted wall gives no return either.
  std::vector<Eigen::Vector3f> no_returns_level_m;
  std::vector<MirrorPoint> mirror;
  BeamCounts counts;
};

struct ScanProjectionConfig {
  double floor_height_odom_m = 0.0;  ///< Height of the take-off floor; the origin of odom is on it.
  double ceiling_height_odom_m = 0.0;
  double max_rise_m =
      1.0;  ///< Under an unknown ceiling, an end point this far above the laser counts as one on the ceiling.
  static constexpr double free_band_m =
      0.30;  ///< A beam that hit no wall clears cells while within this of the body's height.
  double body_radius_m = 0.0;

  void describe(common::config::Fields& fields);
};

/// Projects one sweep. Never fails: beams that cannot be used are counted. A scan whose number of beams differs from
/// the laser's is taken to have no mirror beams. A pure function. `pose_at` is called about ten times: for the middle
/// of the sweep first, then from its beginning to its end.
ProjectedScan project(const common::LaserScan& scan, const common::LaserConfig& laser, const PoseAt& pose_at,
                      const ScanProjectionConfig& config);

/// Projects the sweep of a laser that is carried level. The pose of the robot is taken as constant during the sweep.
ProjectedScan projectLevel(const common::LaserScan& scan, const common::Pose2& T_robot_laser,
                           const common::Pose2& T_odom_robot);

}  // namespace swiftlet::perception
