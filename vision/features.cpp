#include "vision/features.hpp"

#include <cmath>

#include "common/config_fields.hpp"

namespace swiftlet::vision {
namespace {

/// Standard deviation of a corner's pixel, in each direction.
constexpr double kPixelSigma_px = 0.7;
/// A feature whose depth is less certain, as at the edge of a surface, is left out.
constexpr double kGreatestSigma_m = 0.08;

/// Of the weights, which sum to 16, this many must belong to measured pixels.
constexpr int kLeastWeight = 10;

}  // namespace

void DepthNoiseConfig::describe(common::config::Fields& fields) {
  fields("sigma_per_m2", sigma_per_m2, {1e-5, 0.1},
         "Standard deviation of a depth of 1 m; it grows with the square of the depth.");
  fields("nearest_m", nearest_m, {0.0, 5.0}, "Smaller depths are not used.");
  fields("farthest_m", farthest_m, {0.5, 50.0}, "Greater depths are not used.");
}

void FeatureConfig::describe(common::config::Fields& fields) {
  fields.section("depth_noise", depth_noise, "Errors of the depth camera.");
}

std::optional<DepthDistribution> depthMixture(const common::DepthImage& depth, int u_px, int v_px,
                                              const DepthNoiseConfig& noise) {
  if (u_px < 1 || v_px < 1 || u_px + 1 >= depth.width_px || v_px + 1 >= depth.height_px) return std::nullopt;
  if (!noise.isUsable(depth.at(u_px, v_px))) return std::nullopt;
  int weights = 0;
  double sum_m = 0.0, sum_m2 = 0.0;
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du) {
      const float pixel_m = depth.at(u_px + du, v_px + dv);
      if (!noise.isUsable(pixel_m)) continue;
      const int weight = (2 - std::abs(du)) * (2 - std::abs(dv));
      const auto depth_m = static_cast<double>(pixel_m);
      const double sigma_m = noise.sigma_m(depth_m);
      weights += weight;
      sum_m += weight * depth_m;
      sum_m2 += weight * (sigma_m * sigma_m + depth_m * depth_m);
    }
  if (weights < kLeastWeight) return std::nullopt;
  const double mean_m = sum_m / weights;
  return DepthDistribution{mean_m, sum_m2 / weights - mean_m * mean_m};
}

GaussianPoint gaussianPoint(const common::PinholeCamera& camera, const Eigen::Vector2d& pixel, double pixel_sigma_px,
                            const DepthDistribution& depth) {
  // A point is depth * ray; ray = (1, -(u - cx) / fx, -(v - cy) / fy).
  const Eigen::Vector3d ray = camera.point_camera_m(pixel.x(), pixel.y(), 1.0);
  Eigen::Matrix3d covariance = depth.variance_m2 * ray * ray.transpose();
  const double depth_squared_m2 = depth.mean_m * depth.mean_m + depth.variance_m2;
  const double across = pixel_sigma_px / camera.fx_px, down = pixel_sigma_px / camera.fy_px;
  covariance(1, 1) += depth_squared_m2 * across * across;
  covariance(2, 2) += depth_squared_m2 * down * down;
  return {depth.mean_m * ray, covariance};
}

std::vector<Feature> findFeatures(const GrayImage& gray, const common::DepthImage& depth,
                                  const common::PinholeCamera& camera, const FeatureConfig& config) {
  std::vector<Feature> features;
  for (const Corner& corner : findCorners(gray, config.corners)) {
    const auto at = depthMixture(depth, static_cast<int>(std::lround(corner.pixel.x())),
                                 static_cast<int>(std::lround(corner.pixel.y())), config.depth_noise);
    if (!at || at->variance_m2 > kGreatestSigma_m * kGreatestSigma_m) continue;
    const GaussianPoint point = gaussianPoint(camera, corner.pixel, kPixelSigma_px, *at);
    features.push_back({corner.pixel, point.mean_camera_m, point.covariance_camera_m2});
  }
  return features;
}

}  // namespace swiftlet::vision
