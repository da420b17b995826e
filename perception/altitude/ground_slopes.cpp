#include "perception/altitude/ground_slopes.hpp"

#include <cmath>
#include <map>

#include "perception/altitude/ground_cell.hpp"
#include "perception/altitude/ground_limits.hpp"
#include "perception/altitude/ground_plane.hpp"

namespace swiftlet::perception {
namespace {

/// Every n-th pixel in both directions: a cell 4 m away still has a hundred points.
constexpr int kEvery_px = 3;
/// Share of a cell's gradient that becomes part of the bias: some hundred cells of level ground make it known.
constexpr double kBiasGain = 0.01;

}  // namespace

GroundSlopes::GroundSlopes() : cells_(kSlopeCell_m) {}

void GroundSlopes::add(const common::DepthImage& depth, const common::PinholeCamera& camera,
                       const common::Pose3& T_map_camera) {
  if (depth.depth_m.size() != static_cast<std::size_t>(camera.pixels()) || depth.width_px != camera.width_px) return;
  std::map<common::CellIndex, GroundPlane> planes;
  const Eigen::Vector3d& from_map_m = T_map_camera.position_m;
  for (int v = kEvery_px / 2; v < depth.height_px; v += kEvery_px)
    for (int u = kEvery_px / 2; u < depth.width_px; u += kEvery_px) {
      const float depth_m = depth.at(u, v);
      if (!common::isMeasured(depth_m)) continue;
      // Relative to the camera, so that the sums stay small.
      const Eigen::Vector3d point = T_map_camera.rotation * camera.point_camera_m(u, v, depth_m);
      if (point.z() > 0.0) continue;
      const Eigen::Vector2d place_map_m = (from_map_m + point).head<2>();
      if (place_map_m.allFinite()) planes[cells_.cellAt(place_map_m)].add(point);
    }
  const Eigen::Vector3d ahead = T_map_camera.rotation * Eigen::Vector3d::UnitX();
  const Eigen::Rotation2Dd R_map_camera(std::atan2(ahead.y(), ahead.x()));
  for (const auto& [index, plane] : planes) {
    const auto seen = plane.gradient();
    if (!seen) continue;
    const Eigen::Vector2d gradient = *seen - R_map_camera * bias_;
    if (gradient.norm() < kLeastGradient) bias_ += kBiasGain * (R_map_camera.inverse() * gradient);
    auto& square = cells_.at(index);
    square.content.gradient_sum += Eigen::Rotation2Dd(-square.T_map_square.yaw_rad) * gradient;
    ++square.content.images;
  }
}

std::optional<Eigen::Vector2d> GroundSlopes::gradientAt(const Eigen::Vector2d& place_map_m) const {
  if (!place_map_m.allFinite()) return std::nullopt;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int images = 0;
  cells_.visit(cells_.cellAt(place_map_m), [&](const KeyedCells<Cell>::Square& square) {
    sum += Eigen::Rotation2Dd(square.T_map_square.yaw_rad) * square.content.gradient_sum;
    images += square.content.images;
  });
  if (images < kAgreeing) return std::nullopt;
  const Eigen::Vector2d mean = sum / images;
  return mean.norm() < kLeastGradient ? Eigen::Vector2d(0.0, 0.0) : mean;
}

}  // namespace swiftlet::perception
