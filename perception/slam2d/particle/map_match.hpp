// The match of a scan to the map of a particle, fused with the motion before it: the pose at which both together are
// most likely, its covariance, and the likelihood of the scan there. These are the Gaussian proposal and the weight of
// the improved Rao-Blackwellized filter (Grisetti 2007, section III.B). The covariance of the motion is that of the
// laser odometry (Bachrach 2009, section 5.3).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/scan_matching/contour_normals.hpp"
#include "perception/slam2d/surface_map.hpp"
#include "perception/slam2d/uncertain_pose.hpp"

namespace swiftlet::perception {

struct MapMatch {
  common::Pose2 T_map_body;                                  ///< The most likely pose.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< Of the pose, from motion and scan; axes of the map.
  double log_likelihood = 0.0;                               ///< Of the scan in the map at the pose, up to a constant.
  double log_motion = 0.0;                                   ///< Of the motion to the pose; 0: exactly as predicted.
  double support = 0.0;                                      ///< Share of the points on a surface of the map.
};

/// The points of the scan for `matchToMap`.
std::vector<OrientedPoint> pointsToMatch(const ProjectedScan& scan);

/// Matches a scan, predicted at `prior`, by its points from `pointsToMatch`, to the map. Without support in the map the
/// result is the pose of the prior. The covariance of the prior must be positive definite.
MapMatch matchToMap(const SurfaceMap& map, const std::vector<OrientedPoint>& points, const UncertainPose& prior);

}  // namespace swiftlet::perception
