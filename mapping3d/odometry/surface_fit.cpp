#include "mapping3d/odometry/surface_fit.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "common/small_matrices.hpp"

namespace swiftlet::mapping3d {
namespace {

/// Neighbours belong to the same surface within kPlaneSigmas standard deviations, and kSteepest times their distance in
/// pixels times the size of a pixel: a slope of 75 degrees.
constexpr double kPlaneSigmas = 4.0;
constexpr double kSteepest = 3.7;
/// Least share of the pixels that must belong to the surface.
constexpr double kLeastPart = 0.8;
/// The mean square residual of a plane, in variances of the depth.
constexpr double kGreatestChi2 = 4.0;
/// A surface seen at a smaller angle has no reliable depth: the sine of 10 degrees.
constexpr double kLeastCosine = 0.17;

}  // namespace

std::optional<SurfaceFit> fitSurface(const common::DepthImage& depth, const common::PinholeCamera& camera, int u_px,
                                     int v_px, int reach_px, const vision::DepthNoiseConfig& noise) {
  if (u_px < reach_px || v_px < reach_px || u_px + reach_px >= depth.width_px || v_px + reach_px >= depth.height_px)
    return std::nullopt;
  const float centre = depth.at(u_px, v_px);
  if (!noise.isUsable(centre)) return std::nullopt;
  const auto centre_m = static_cast<double>(centre);
  const double gate_m = kPlaneSigmas * noise.sigma_m(centre_m);
  const double pixel_m = centre_m / camera.fx_px;
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0.0;
  int used = 0;
  for (int dv = -reach_px; dv <= reach_px; ++dv)
    for (int du = -reach_px; du <= reach_px; ++du) {
      const float pixel = depth.at(u_px + du, v_px + dv);
      if (!noise.isUsable(pixel)) continue;
      const auto there_m = static_cast<double>(pixel);
      const double apart_px = std::max(std::abs(du), std::abs(dv));
      if (std::abs(there_m - centre_m) > gate_m + kSteepest * apart_px * pixel_m) continue;
      const double inverse = 1.0 / there_m;
      const Eigen::Vector3d row(du, dv, 1.0);
      products += row * row.transpose();
      right += inverse * row;
      squares += inverse * inverse;
      ++used;
    }
  const int side_px = 2 * reach_px + 1;
  if (used < kLeastPart * side_px * side_px) return std::nullopt;
  const Eigen::Vector3d plane = common::leastNormSolution(products, right);
  if (!(plane.z() > 0.0)) return std::nullopt;
  // An error of the depth is one of the inverse depth times its square.
  const double sigma = noise.sigma_m(centre_m) / (centre_m * centre_m);
  if ((squares - plane.dot(right)) / used > kGreatestChi2 * sigma * sigma) return std::nullopt;
  // 1 / x = a (u - u0) + b (v - v0) + c, with u = cx - fx y / x and v = cy - fy z / x, is a plane in x, y and z.
  const double at_centre = plane.x() * (camera.cx_px - u_px) + plane.y() * (camera.cy_px - v_px) + plane.z();
  Eigen::Vector3d normal(at_centre, -plane.x() * camera.fx_px, -plane.y() * camera.fy_px);
  normal.normalize();
  const Eigen::Vector3d view = camera.point_camera_m(u_px, v_px, 1.0).normalized();
  if (normal.dot(view) > 0.0) normal = -normal;
  if (normal.dot(view) > -kLeastCosine) return std::nullopt;
  return SurfaceFit{1.0 / plane.z(), normal};
}

}  // namespace swiftlet::mapping3d
