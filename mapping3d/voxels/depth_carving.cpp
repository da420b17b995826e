#include "mapping3d/voxels/depth_carving.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mapping3d/voxels/ray_walk.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;
using Eigen::Vector3d;
using Eigen::Vector3f;

/// Half of the diagonal of a cube of side 1.
constexpr float kHalfDiagonal = 0.5F * std::numbers::sqrt3_v<float>;
/// Voxels whose centre is nearer than this many sides are found by walking along rays.
constexpr float kNearVoxels = 3.0F;
/// Of these rays each fourth along rows and columns: at this distance they are much closer than a voxel is wide.
constexpr int kNearStride = 4;
/// Side of the largest squares of the pyramid: that of a block in the middle of its range.
constexpr int kSideMax_px = 64;

/// Calls visit(block) for each block of the window that may be in view: those in the cube around the view's pyramid.
template <typename Visit>
void forBlocksAround(const common::PinholeCamera& camera, const Vector3d& origin_m, const Eigen::Matrix3d& rotation,
                     double range_m, double block_side_m, const ScanWindow& window, Visit&& visit) {
  Vector3d least_m = origin_m, greatest_m = origin_m;
  for (const double u : {0.0, camera.width_px - 1.0}) {
    for (const double v : {0.0, camera.height_px - 1.0}) {
      const Vector3d corner_m = origin_m + rotation * camera.point_camera_m(u, v, range_m);
      least_m = least_m.cwiseMin(corner_m);
      greatest_m = greatest_m.cwiseMax(corner_m);
    }
  }
  const auto block = [&](double m) { return static_cast<int>(std::floor(m / block_side_m)); };
  const VoxelIndex low = window.first(), high = window.last();
  for (int z = std::max(block(least_m.z()), low.z); z <= std::min(block(greatest_m.z()), high.z); ++z)
    for (int y = std::max(block(least_m.y()), low.y); y <= std::min(block(greatest_m.y()), high.y); ++y)
      for (int x = std::max(block(least_m.x()), low.x); x <= std::min(block(greatest_m.x()), high.x); ++x)
        visit(VoxelIndex{x, y, z});
}

}  // namespace

DepthCarving::DepthCarving(double range_max_m, double resolution_m)
    : range_max_m_(range_max_m),
      resolution_m_(resolution_m),
      near_m_(kNearVoxels * static_cast<float>(resolution_m)),
      deepest_(DepthPyramid::Of::kGreatest, kSideMax_px),
      shallowest_(DepthPyramid::Of::kLeast, kSideMax_px) {}

void DepthCarving::carve(const std::vector<float>& free_m, const common::PinholeCamera& camera,
                         const common::Pose3& T_map_camera, ScanWindow& window) {
  camera_ = camera;
  fx_px_ = static_cast<float>(camera.fx_px);
  fy_px_ = static_cast<float>(camera.fy_px);
  cx_px_ = static_cast<float>(camera.cx_px);
  cy_px_ = static_cast<float>(camera.cy_px);
  origin_map_m_ = T_map_camera.position_m;
  rotation_map_camera_ = T_map_camera.rotation.toRotationMatrix();
  rotation_camera_map_ = rotation_map_camera_.transpose().cast<float>();
  const auto side = static_cast<float>(resolution_m_);
  half_extent_m_ = 0.5F * side * rotation_camera_map_.cwiseAbs().rowwise().sum();
  // A voxel contains a ball of its side's width. A ray meets it if the diagonal from ray to ray is not wider.
  dense_m_ = side / std::numbers::sqrt2_v<float> * std::min(fx_px_, fy_px_);
  deepest_.build(free_m, camera.width_px, camera.height_px);
  shallowest_.build(free_m, camera.width_px, camera.height_px);

  carveNear(window);
  const double side_m = resolution_m_ * VoxelBlock::kSide;
  forBlocksAround(camera_, origin_map_m_, rotation_map_camera_, range_max_m_, side_m, window, [&](VoxelIndex block) {
    const Vector3d center_m = (Vector3d(block.x, block.y, block.z).array() + 0.5).matrix() * side_m - origin_map_m_;
    const Vector3f center_camera_m = rotation_camera_map_ * center_m.cast<float>();
    if (cubeCrossed(VoxelBlock::kSide, center_camera_m) == Crossed::kNone) return;
    carveCube(VoxelMap::firstOf(block), VoxelBlock::kSide, center_camera_m, window.at(block).crossed);
  });
}

/// Walks along some of the rays up to a little more than the nearest voxels that the projection decides.
void DepthCarving::carveNear(ScanWindow& window) const {
  const float far_m = near_m_ + 2.0F * kHalfDiagonal * static_cast<float>(resolution_m_);
  const Vector3d origin = origin_map_m_ / resolution_m_;
  for (int v = 0; v < camera_.height_px; v += kNearStride) {
    for (int u = 0; u < camera_.width_px; u += kNearStride) {
      const double depth_m = static_cast<double>(std::min(deepest_.at(u, v), far_m));
      if (depth_m <= 0.0) continue;
      const Vector3d end = origin + rotation_map_camera_ * camera_.point_camera_m(u, v, depth_m) / resolution_m_;
      for (RayWalk walk(origin, end); !walk.atEnd(); walk.advance())
        window.at(VoxelMap::blockOf(walk.cell())).crossed.set(VoxelBlock::offsetOf(walk.cell()));
    }
  }
}

void DepthCarving::carveCube(VoxelIndex first, int side, const Vector3f& center_camera_m, VoxelBits& crossed) const {
  if (side == 1) {
    if (center_camera_m.x() >= near_m_ && voxelCrossed(first, center_camera_m))
      crossed.set(VoxelBlock::offsetOf(first));
    return;
  }
  const Crossed which = cubeCrossed(side, center_camera_m);
  if (which == Crossed::kNone) return;
  if (which == Crossed::kAll) {
    for (int z = first.z; z < first.z + side; ++z)
      for (int y = first.y; y < first.y + side; ++y)
        for (int x = first.x; x < first.x + side; ++x) crossed.set(VoxelBlock::offsetOf({x, y, z}));
    return;
  }
  const int half = side / 2;
  const Eigen::Matrix3f step_m = rotation_camera_map_ * (0.5F * static_cast<float>(half * resolution_m_));
  for (int octant = 0; octant < 8; ++octant) {
    const int x = octant & 1, y = octant >> 1 & 1, z = octant >> 2;
    const Vector3f sign(static_cast<float>(2 * x - 1), static_cast<float>(2 * y - 1), static_cast<float>(2 * z - 1));
    carveCube({first.x + half * x, first.y + half * y, first.z + half * z}, half, center_camera_m + step_m * sign,
              crossed);
  }
}

DepthCarving::Crossed DepthCarving::cubeCrossed(int side, const Vector3f& center_camera_m) const {
  const float extent_m = static_cast<float>(side) * half_extent_m_.x();
  const float nearest_m = center_camera_m.x() - extent_m, farthest_m = center_camera_m.x() + extent_m;
  const float radius_m = kHalfDiagonal * static_cast<float>(side * resolution_m_);
  if (farthest_m < near_m_ || center_camera_m.norm() - radius_m > range_max_m_) return Crossed::kNone;
  if (nearest_m <= near_m_) return Crossed::kSome;
  const Rectangle pixels = pixelsOf(side, center_camera_m);
  if (pixels.empty()) return Crossed::kNone;
  if (deepest_.inRectangle(pixels.u_first, pixels.v_first, pixels.u_last, pixels.v_last) <= nearest_m)
    return Crossed::kNone;
  if (pixels.cut || farthest_m > dense_m_) return Crossed::kSome;
  return shallowest_.inRectangle(pixels.u_first, pixels.v_first, pixels.u_last, pixels.v_last) > farthest_m
             ? Crossed::kAll
             : Crossed::kSome;
}

/// The pixels whose rays may meet the cube. For a point at the offset (dx, dy) from the centre (x, y), u differs by
/// fx (dy - y / x dx) / (x + dx), and v likewise.
DepthCarving::Rectangle DepthCarving::pixelsOf(int side, const Vector3f& center_camera_m) const {
  const float per_depth = 1.0F / center_camera_m.x();
  const float slope_u = center_camera_m.y() * per_depth, slope_v = center_camera_m.z() * per_depth;
  const Vector3f extent_m = static_cast<float>(side) * half_extent_m_;
  const float per_nearest = 1.0F / (center_camera_m.x() - extent_m.x());
  const float half_u_px = fx_px_ * (extent_m.y() + std::abs(slope_u) * extent_m.x()) * per_nearest;
  const float half_v_px = fy_px_ * (extent_m.z() + std::abs(slope_v) * extent_m.x()) * per_nearest;
  return pixelsAround(cx_px_ - fx_px_ * slope_u, cy_px_ - fy_px_ * slope_v, half_u_px, half_v_px);
}

DepthCarving::Rectangle DepthCarving::pixelsAround(float u, float v, float half_u_px, float half_v_px) const {
  // A conversion to int rounds towards 0, which is down for positive numbers. It is much faster than std::floor.
  const auto first = [](float least, int size) {
    const auto end = static_cast<float>(size);
    return size - static_cast<int>(end - std::clamp(least, 0.0F, end));
  };
  const auto last = [](float greatest, int size) {
    return static_cast<int>(std::clamp(greatest, -1.0F, static_cast<float>(size - 1)) + 1.0F) - 1;
  };
  const int width = camera_.width_px, height = camera_.height_px;
  const bool cut = u - half_u_px < 0.0F || v - half_v_px < 0.0F || u + half_u_px > static_cast<float>(width - 1) ||
                   v + half_v_px > static_cast<float>(height - 1);
  return {first(u - half_u_px, width), first(v - half_v_px, height), last(u + half_u_px, width),
          last(v + half_v_px, height), cut};
}

bool DepthCarving::voxelCrossed(VoxelIndex voxel, const Vector3f& center_camera_m) const {
  const float per_depth = 1.0F / center_camera_m.x();
  const float u = cx_px_ - fx_px_ * center_camera_m.y() * per_depth;
  const float v = cy_px_ - fy_px_ * center_camera_m.z() * per_depth;
  // The ball within the voxel has the radius of half a side; a square within its picture has 1 / sqrt(2) of that.
  const float inner_px =
      static_cast<float>(resolution_m_) * std::min(fx_px_, fy_px_) * per_depth * 0.5F / std::numbers::sqrt2_v<float>;
  const Rectangle inner = pixelsAround(u, v, inner_px, inner_px);
  if (!inner.empty() && deepest_.inSquareWithin(inner.u_first, inner.v_first, inner.u_last, inner.v_last) >
                            center_camera_m.x() + half_extent_m_.x())
    return true;

  const float nearest_m = center_camera_m.x() - half_extent_m_.x();
  const Rectangle outer = pixelsOf(1, center_camera_m);
  if (outer.empty() || deepest_.inRectangle(outer.u_first, outer.v_first, outer.u_last, outer.v_last) <= nearest_m)
    return false;
  return anyRayCrosses(voxel, outer, nearest_m);
}

/// A ray enters the voxel before it ends, and does not end within it. The fourth lane of the arrays stands still, so
/// that all three axes are divided at once.
bool DepthCarving::anyRayCrosses(VoxelIndex voxel, const Rectangle& pixels, float nearest_m) const {
  const auto lanes = [](const Vector3f& point, float rest) {
    return Eigen::Array4f(point.x(), point.y(), point.z(), rest);
  };
  const Vector3d least_m = Vector3d(voxel.x, voxel.y, voxel.z) * resolution_m_ - origin_map_m_;
  const Eigen::Array4f least = lanes(least_m.cast<float>(), -1e9F);
  const Eigen::Array4f greatest = lanes((least_m.array() + resolution_m_).matrix().cast<float>(), 1e9F);
  const Eigen::Array4f per_u = lanes(-rotation_camera_map_.row(1).transpose() / fx_px_, 0.0F);
  // From the middle row outwards, as rays through the middle of the voxel cross it most likely.
  const int rows = pixels.v_last - pixels.v_first + 1, middle = pixels.v_first + rows / 2;
  for (int row = 0; row < rows; ++row) {
    const int v = middle + (row % 2 == 0 ? row / 2 : -(row + 1) / 2);
    const Vector3f ray_camera(1.0F, (cx_px_ - static_cast<float>(pixels.u_first)) / fx_px_,
                              (cy_px_ - static_cast<float>(v)) / fy_px_);
    Eigen::Array4f ray = lanes(rotation_camera_map_.transpose() * ray_camera, 1.0F);
    for (int u = pixels.u_first; u <= pixels.u_last; ++u, ray += per_u) {
      const float free_m = deepest_.at(u, v);
      if (free_m <= nearest_m) continue;
      const Eigen::Array4f inverse = ray.inverse(), a = least * inverse, b = greatest * inverse;
      const float enters_m = a.min(b).maxCoeff(), leaves_m = a.max(b).minCoeff();
      if (enters_m < leaves_m && leaves_m <= free_m) return true;
    }
  }
  return false;
}

}  // namespace swiftlet::mapping3d
