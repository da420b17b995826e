// Features: corners with their place in space and its uncertainty.
//
// Source: I. Dryanovski, R. G. Valenti, J. Xiao, "Fast visual odometry and mapping from RGB-D data", ICRA 2013, section
// III: the pixel of a corner is uncertain, so its depth is a mixture of Gaussians over the 3x3 neighbourhood.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/rgbd_frame.hpp"
#include "vision/corners.hpp"

namespace swiftlet::vision {

/// How a depth camera by structured light errs.
struct DepthNoiseConfig {
  double sigma_per_m2 = 1.45e-3;
  double nearest_m = 0.3;
  double farthest_m = 5.0;

  /// Standard deviation of a measured depth; it grows with its square, as disparity is what the camera measures.
  double sigma_m(double depth_m) const { return sigma_per_m2 * depth_m * depth_m; }
  bool isUsable(float depth_m) const {
    return static_cast<double>(depth_m) >= nearest_m && static_cast<double>(depth_m) <= farthest_m;
  }

  void describe(common::config::Fields& fields);
};

/// Mean and variance of the depth at a pixel.
struct DepthDistribution {
  double mean_m = 0.0;
  double variance_m2 = 0.0;
};

/// The mixture over the 3x3 neighbourhood with binomial weights. None if the pixel itself or most of its neighbours
/// were not measured, or lie at the border.
std::optional<DepthDistribution> depthMixture(const common::DepthImage& depth, int u_px, int v_px,
                                              const DepthNoiseConfig& noise);

/// Mean and covariance of the point at an uncertain pixel with an uncertain depth, in the camera frame. The moments are
/// exact for independent errors, not linearized.
struct GaussianPoint {
  Eigen::Vector3d mean_camera_m;
  Eigen::Matrix3d covariance_camera_m2;
};
GaussianPoint gaussianPoint(const common::PinholeCamera& camera, const Eigen::Vector2d& pixel, double pixel_sigma_px,
                            const DepthDistribution& depth);

struct FeatureConfig {
  CornerConfig corners;
  DepthNoiseConfig depth_noise;

  void describe(common::config::Fields& fields);
};

struct Feature {
  Eigen::Vector2d pixel;
  Eigen::Vector3d mean_camera_m;
  Eigen::Matrix3d covariance_camera_m2;
};

/// The corners of the picture that have a depth. Corners at the edge of a surface, whose depth could be that of the
/// background, are left out.
std::vector<Feature> findFeatures(const GrayImage& gray, const common::DepthImage& depth,
                                  const common::PinholeCamera& camera, const FeatureConfig& config);

}  // namespace swiftlet::vision
