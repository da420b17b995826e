// A scan matched to the map of a particle, with what the motion before it says: the pose at which both together are
// most likely, how uncertain it is, and how likely the scan is there. That is the Gaussian proposal and the weight of
// the improved Rao-Blackwellized filter (Grisetti 2007, section III.B), with the covariance of the laser odometry for
// the motion (Bachrach 2009, section 5.3).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/scan_matching/contour_normals.hpp"
#include "perception/slam2d/particle/particle_map.hpp"

namespace swiftlet::perception {

struct MapMatchConfig {
  int points = 180;             ///< Of a scan that are matched, spread evenly along its contour.
  int coarse_points = 60;       ///< The same while they are still far from the surfaces they belong to.
  double max_range_m = 20.0;    ///< Points farther than this are not used.
  double reach_m = 0.30;        ///< Where the motion may have slipped, a surface is looked for so far along the normal,
  double support_m = 0.08;      ///< else so near.
  double enough_support = 0.7;  ///< With a greater share of points on a surface the motion has not slipped.
  int iterations = 10;          ///< Most steps.
  double residual_m = 0.02;     ///< Distances of the points from the surfaces are taken for at least so large.
  double covariance_scale = 2.0;  ///< On the covariance of independent points, which neighbouring ones are not.
  double motion_freedom =
      3.0;                     ///< Degrees of freedom of the motion's Student t: its covariance does not know of slips.
  double beam_sigma_m = 0.05;  ///< Spread of end points about the surfaces of a good map: of the likelihood.
  double outlier_share = 0.1;  ///< Of end points on what is not in the map.
  double independent_beams = 20.0;  ///< A scan says as much as so many beams that know nothing of each other.
};

/// Where the scan is expected: T_map_body, and the covariance of its additive errors (x_m, y_m, yaw_rad), axes of map.
struct MotionPrior {
  common::Pose2 T_map_body;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

struct MapMatch {
  common::Pose2 T_map_body;                                  ///< The most likely one.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< About it, of motion and scan together; axes of map.
  double log_likelihood = 0.0;                               ///< Of the scan in the map there, up to a constant.
  double log_motion = 0.0;                                   ///< Of the motion that led there; 0: just as expected.
  double support = 0.0;                                      ///< Share of the points on a surface of the map.
};

/// The points of the scan that `matchToMap` takes.
std::vector<OrientedPoint> pointsToMatch(const ProjectedScan& scan, const MapMatchConfig& config, double max_gap_m);

/// Without any support the pose is that of the prior. The points are those of `pointsToMatch`; the covariance of the
/// prior must be positive definite.
MapMatch matchToMap(const ParticleMap& map, const std::vector<OrientedPoint>& points, const MotionPrior& prior,
                    const MapMatchConfig& config);

}  // namespace swiftlet::perception
