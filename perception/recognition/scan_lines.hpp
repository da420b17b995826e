// Walls and corners in one scan of a laser, by split and merge (T. Pavlidis, S. Horowitz, "Segmentation of plane
// curves", IEEE Trans. Computers 1974; of six methods the fastest and among the most correct: V. Nguyen et al., "A
// comparison of line extraction algorithms using 2D laser rangefinder", IROS 2005). Tomic 2012, section "Recognition":
// "The laser object detector is able to detect corners in a room, walls, and windows."
//
// Coordinates are those of the frame `laser`.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/sensor_event.hpp"

namespace swiftlet::perception {

/// How a laser errs, and what counts as a wall.
struct ScanLineConfig {
  double range_sigma_m = 0.02;  ///< Standard deviation of a range.
  double length_min_m = 0.5;    ///< Shorter lines are furniture.
  int beams_min = 8;            ///< Lines of fewer beams are chance.
};

/// A straight piece of wall: all points with normal . point = distance, between two ends.
struct ScanLine {
  double angle_rad = 0.0;                                ///< Of its normal, which points away from the laser.
  double distance_m = 0.0;                               ///< From the laser, at least 0.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< Of (angle, distance).
  Eigen::Vector2d begin_m, end_m;                        ///< The feet of its first and last beam.
  int beams = 0;

  Eigen::Vector2d normal() const;
  double length_m() const { return (end_m - begin_m).norm(); }
};

/// Where two walls meet.
struct ScanCorner {
  Eigen::Vector2d point_m;
  double heading_rad = 0.0;  ///< Direction of the bisector, from the corner into the space that the laser sees.
  double opening_rad = 0.0;  ///< Angle of that space: below pi for the corner of a room, above for that of a pillar.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of (x, y, heading).
  int first_line = 0;                                    ///< Index of the wall before it, in the order of the beams.
};

/// In the order of the beams. Beams without a valid return end a line.
std::vector<ScanLine> findLines(const common::LaserScan& scan, const ScanLineConfig& config);
/// Of neighbouring lines that end where they meet.
std::vector<ScanCorner> findCorners(const std::vector<ScanLine>& lines, const ScanLineConfig& config);

}  // namespace swiftlet::perception
