// The match of a scan to the map of a particle, fused with the motion before it: the pose at which both together are
// most likely, its covariance, and the likelihood of the scan there. These are the Gaussian proposal and the weight of
// the improved Rao-Blackwellized filter (Grisetti 2007, section III.B). The covariance of the motion is that of the
// laser odometry (Bachrach 2009, section 5.3).
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "perception/scan_matching/contour_normals.hpp"
#include "perception/slam2d/surface_map.hpp"

namespace swiftlet::perception {

struct MapMatchConfig {
  static constexpr int points = 180;  ///< Points of a scan that are matched, spread evenly along its contour.
  static constexpr int coarse_points =
      60;  ///< Points that are matched while they are still far from the surfaces they belong to.
  static constexpr double max_range_m = 20.0;  ///< Points farther than this are not used.
  static constexpr double reach_m =
      0.30;  ///< Where the motion may have slipped, a surface is searched this far along the normal of a point.
  static constexpr double support_m =
      0.08;  ///< Where the motion has not slipped, a surface is searched this near a point.
  static constexpr double enough_support =
      0.7;                               ///< With a greater share of points on a surface the motion has not slipped.
  static constexpr int iterations = 10;  ///< Greatest number of steps.
  static constexpr double residual_m = 0.02;  ///< Least distance of a point from its surface that the weights assume.
  static constexpr double covariance_scale =
      2.0;  ///< Factor on the covariance of independent points, which neighbouring ones are not.
  static constexpr double motion_freedom = 3.0;  ///< Degrees of freedom of the Student t distribution of the motion:
                                                 ///< the motion's covariance does not include slips.
  static constexpr double beam_sigma_m =
      0.05;  ///< Spread, in the likelihood, of end points about the surfaces of a good map.
  static constexpr double outlier_share = 0.1;       ///< Share of end points on what is not in the map.
  static constexpr double independent_beams = 20.0;  ///< Number of independent beams that a scan counts for.
};

/// The predicted pose of a scan, and the covariance of its additive errors (x_m, y_m, yaw_rad), axes of the map.
struct MotionPrior {
  common::Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

struct MapMatch {
  common::Pose2 T_map_body;                                  ///< The most likely pose.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< Of the pose, from motion and scan; axes of the map.
  double log_likelihood = 0.0;                               ///< Of the scan in the map at the pose, up to a constant.
  double log_motion = 0.0;                                   ///< Of the motion to the pose; 0: exactly as predicted.
  double support = 0.0;                                      ///< Share of the points on a surface of the map.
};

/// The points of the scan for `matchToMap`.
std::vector<OrientedPoint> pointsToMatch(const ProjectedScan& scan, const MapMatchConfig& config, double max_gap_m);

/// Matches a scan, by its points from `pointsToMatch`, to the map. Without support in the map the result is the pose of
/// the prior. The covariance of the prior must be positive definite.
MapMatch matchToMap(const SurfaceMap& map, const std::vector<OrientedPoint>& points, const MotionPrior& prior,
                    const MapMatchConfig& config);

}  // namespace swiftlet::perception
