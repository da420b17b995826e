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
using Eigen::Array4f;
using Eigen::Vector3d;
using Eigen::Vector3f;

/// Half of the diagonal of a cube of side 1.
constexpr float kHalfDiagonal = 0.5F * std::numbers::sqrt3_v<float>;
/// Voxels whose centre is nearer than this many sides are found by walking along rays.
constexpr float kNearVoxels = 3.0F;
/// Number of those rays on a voxel's side.
constexpr float kNearRays = 3.0F;
/// Side of the largest squares of the pyramid: that of a block in the middle of its range.
constexpr int kSideMax = 64;
/// A ray through the middle of a voxel crosses it if it ends by at least this many sides beyond the middle; half a side
/// is where such a ray leaves it at the latest, if it is parallel to an axis. Others leave it earlier.
constexpr float kLeaves = 0.25F;
/// At the edge of the view the outermost rays still cross voxels whose middle lies beside them, up to this share of
/// what the voxel extends towards them: few rays meet a corner.
constexpr float kBeside = 0.95F;
/// Sides of squares are powers of two, rounded down. With this factor they are 0.7 to 1.4 times as wide as the voxel is
/// in the image.
constexpr float kSquare = std::numbers::sqrt2_v<float>;
/// Side of the cubes below which single voxels are decided: four of them at once.
constexpr int kCube = 4;

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
      deepest_(DepthPyramid::Of::kGreatest, kSideMax),
      shallowest_(DepthPyramid::Of::kLeast, kSideMax) {}

void DepthCarving::carve(const std::vector<float>& free_m, const common::PinholeCamera& camera,
                         const common::Pose3& T_map_camera, ScanWindow& window) {
  follow(camera, T_map_camera);
  deepest_.build(free_m, camera.width_px, camera.height_px, groups_.side_px);
  shallowest_.build(free_m, camera.width_px, camera.height_px, groups_.side_px);
  carveNear(window);
  const double side_m = resolution_m_ * VoxelBlock::kSide;
  forBlocksAround(camera_, origin_map_m_, rotation_map_camera_, range_max_m_, side_m, window, [&](VoxelIndex block) {
    const Vector3d center_m = (Vector3d(block.x, block.y, block.z).array() + 0.5).matrix() * side_m - origin_map_m_;
    const Vector3f center_camera_m = rotation_camera_map_ * center_m.cast<float>();
    const Crossed which = cubeCrossed(VoxelBlock::kSide, center_camera_m);
    if (which == Crossed::kNone) return;
    if (which == Crossed::kAll)
      window.at(block).crossed.setAll();
    else
      carveBlock(center_camera_m, window.at(block).crossed);
  });
}

/// Groups of two by two pixels where the farthest voxel is at least two pixels wide.
void DepthCarving::follow(const common::PinholeCamera& camera, const common::Pose3& T_map_camera) {
  camera_ = camera;
  const double least_px = resolution_m_ * std::min(camera.fx_px, camera.fy_px) / range_max_m_;
  groups_ = PixelGroups(camera, least_px >= 2.0 ? 2 : 1);
  origin_map_m_ = T_map_camera.position_m;
  rotation_map_camera_ = T_map_camera.rotation.toRotationMatrix();
  rotation_camera_map_ = rotation_map_camera_.transpose().cast<float>();
  half_extent_m_ = 0.5F * static_cast<float>(resolution_m_) * rotation_camera_map_.cwiseAbs().rowwise().sum();

  // A point (x, y, z) is to the left of the plane of the rays at u if fu y > (cu - u) x: by at most this in a voxel.
  const auto extent_m = [this](const Vector3f& normal_camera) {
    return kBeside * 0.5F * static_cast<float>(resolution_m_) *
           (rotation_camera_map_.transpose() * normal_camera).lpNorm<1>();
  };
  beside_first_m_ = {extent_m({groups_.first_ray.x() - groups_.cu, groups_.fu, 0.0F}),
                     extent_m({groups_.first_ray.y() - groups_.cv, 0.0F, groups_.fv})};
  beside_last_m_ = {extent_m({groups_.last_ray.x() - groups_.cu, groups_.fu, 0.0F}),
                    extent_m({groups_.last_ray.y() - groups_.cv, 0.0F, groups_.fv})};
}

/// Walks along some of the rays up to a little more than the nearest voxels that the projection decides.
void DepthCarving::carveNear(ScanWindow& window) const {
  const float far_m = near_m_ + 2.0F * kHalfDiagonal * static_cast<float>(resolution_m_);
  const float apart = static_cast<float>(resolution_m_) / kNearRays / far_m * std::min(groups_.fu, groups_.fv);
  const int stride = std::clamp(static_cast<int>(apart), 1, kSideMax);
  const Vector3d origin = origin_map_m_ / resolution_m_;
  for (int v = 0; v < groups_.height; v += stride) {
    for (int u = 0; u < groups_.width; u += stride) {
      const int u_last = std::min(u + stride, groups_.width) - 1, v_last = std::min(v + stride, groups_.height) - 1;
      const double depth_m = static_cast<double>(std::min(deepest_.inRectangle(u, v, u_last, v_last), far_m));
      if (depth_m <= 0.0) continue;
      const double u_px = 0.5 * (u + u_last + 1) * groups_.side_px - 0.5,
                   v_px = 0.5 * (v + v_last + 1) * groups_.side_px - 0.5;
      const Vector3d end = origin + rotation_map_camera_ * camera_.point_camera_m(u_px, v_px, depth_m) / resolution_m_;
      for (RayWalk walk(origin, end); !walk.atEnd(); walk.advance())
        window.at(VoxelMap::blockOf(walk.cell())).crossed.set(VoxelBlock::offsetOf(walk.cell()));
    }
  }
}

void DepthCarving::carveBlock(const Vector3f& center_camera_m, VoxelBits& crossed) const {
  const Eigen::Matrix3f step_m = rotation_camera_map_ * (0.5F * static_cast<float>(kCube * resolution_m_));
  for (int octant = 0; octant < 8; ++octant) {
    const int x = octant & 1, y = octant >> 1 & 1, z = octant >> 2;
    const Vector3f sign(static_cast<float>(2 * x - 1), static_cast<float>(2 * y - 1), static_cast<float>(2 * z - 1));
    const Vector3f center_m = center_camera_m + step_m * sign;
    const Crossed which = cubeCrossed(kCube, center_m);
    if (which == Crossed::kNone) continue;
    const int offset = VoxelBlock::offsetOf({kCube * x, kCube * y, kCube * z});
    if (which == Crossed::kSome) {
      carveVoxels(offset, center_m, crossed);
      continue;
    }
    for (int row = 0; row < kCube * kCube; ++row)
      crossed.setFour(offset + VoxelBlock::offsetOf({0, row % kCube, row / kCube}), 0xFU);
  }
}

/// Four voxels of a row at once.
void DepthCarving::carveVoxels(int offset, const Vector3f& center_camera_m, VoxelBits& crossed) const {
  const auto side_m = static_cast<float>(resolution_m_);
  const Eigen::Matrix3f axes_m = rotation_camera_map_ * side_m;  // The steps to the next voxel along x, y and z.
  const Vector3f first_m = center_camera_m - 0.5F * (kCube - 1) * axes_m.rowwise().sum();
  const float depth_m = std::max(center_camera_m.x(), near_m_);
  const Vector3f ray_map = rotation_camera_map_.transpose() * center_camera_m / depth_m;
  const float leaves_m = kLeaves * side_m / ray_map.cwiseAbs().maxCoeff();
  const float width = side_m * std::min(groups_.fu, groups_.fv) / depth_m;
  const DepthPyramid::Squares squares = deepest_.squaresOf(std::max(1, static_cast<int>(kSquare * width)));
  const float half = 0.5F * static_cast<float>(squares.side - 1);
  const auto u_last = static_cast<float>(groups_.width - squares.side),
             v_last = static_cast<float>(groups_.height - squares.side);
  const Eigen::Array2f least = groups_.first_ray - beside_first_m_ / depth_m,
                       greatest = groups_.last_ray + beside_last_m_ / depth_m;
  const Array4f lane(0.0F, 1.0F, 2.0F, 3.0F);
  for (int z = 0; z < kCube; ++z)
    for (int y = 0; y < kCube; ++y) {
      const Vector3f row_m = first_m + static_cast<float>(y) * axes_m.col(1) + static_cast<float>(z) * axes_m.col(2);
      const Array4f x_m = row_m.x() + axes_m(0, 0) * lane, inverse = 1.0F / x_m;
      const Array4f u = groups_.cu - groups_.fu * (row_m.y() + axes_m(1, 0) * lane) * inverse;
      const Array4f v = groups_.cv - groups_.fv * (row_m.z() + axes_m(2, 0) * lane) * inverse;
      const Eigen::Array4i column = (u - half).min(u_last).max(0.0F).cast<int>();
      const Eigen::Array4i line = (v - half).min(v_last).max(0.0F).cast<int>();
      unsigned four = 0;
      for (int i = 0; i < 4; ++i) {
        const bool in_view =
            x_m[i] >= near_m_ && u[i] >= least.x() && u[i] <= greatest.x() && v[i] >= least.y() && v[i] <= greatest.y();
        if (in_view && squares.at(column[i], line[i]) > x_m[i] + leaves_m) four |= 1U << i;
      }
      crossed.setFour(offset + VoxelBlock::offsetOf({0, y, z}), four);
    }
}

DepthCarving::Crossed DepthCarving::cubeCrossed(int side, const Vector3f& center_camera_m) const {
  const float extent_m = static_cast<float>(side) * half_extent_m_.x();
  const float nearest_m = center_camera_m.x() - extent_m, farthest_m = center_camera_m.x() + extent_m;
  const float radius_m = kHalfDiagonal * static_cast<float>(side * resolution_m_);
  const auto beyond_m = static_cast<float>(range_max_m_) + radius_m;
  if (farthest_m < near_m_ || center_camera_m.squaredNorm() > beyond_m * beyond_m) return Crossed::kNone;
  if (nearest_m <= near_m_) return Crossed::kSome;
  const Rectangle groups = groupsOf(side, center_camera_m);
  if (groups.empty()) return Crossed::kNone;
  if (deepest_.inRectangle(groups.u_first, groups.v_first, groups.u_last, groups.v_last) <= nearest_m)
    return Crossed::kNone;
  if (groups.cut) return Crossed::kSome;
  return shallowest_.inRectangle(groups.u_first, groups.v_first, groups.u_last, groups.v_last) > farthest_m
             ? Crossed::kAll
             : Crossed::kSome;
}

/// The groups whose rays may meet the cube. For a point at the offset (dx, dy) from the centre (x, y), u differs by
/// f (dy - y / x dx) / (x + dx), and v likewise.
DepthCarving::Rectangle DepthCarving::groupsOf(int side, const Vector3f& center_camera_m) const {
  const float per_depth = 1.0F / center_camera_m.x();
  const float slope_u = center_camera_m.y() * per_depth, slope_v = center_camera_m.z() * per_depth;
  const Vector3f extent_m = static_cast<float>(side) * half_extent_m_;
  const float per_nearest = 1.0F / (center_camera_m.x() - extent_m.x());
  const float half_u = groups_.fu * (extent_m.y() + std::abs(slope_u) * extent_m.x()) * per_nearest;
  const float half_v = groups_.fv * (extent_m.z() + std::abs(slope_v) * extent_m.x()) * per_nearest;
  const float u = groups_.cu - groups_.fu * slope_u, v = groups_.cv - groups_.fv * slope_v;
  const auto u_end = static_cast<float>(groups_.width), v_end = static_cast<float>(groups_.height);
  const bool cut = u - half_u < 0.0F || v - half_v < 0.0F || u + half_u >= u_end || v + half_v >= v_end;
  if (u + half_u < 0.0F || v + half_v < 0.0F || u - half_u >= u_end || v - half_v >= v_end) return {0, 0, -1, -1, cut};
  // A conversion to int rounds towards 0, which is down for positive numbers. It is much faster than std::floor.
  return {static_cast<int>(std::max(u - half_u, 0.0F)), static_cast<int>(std::max(v - half_v, 0.0F)),
          static_cast<int>(std::min(u + half_u, u_end - 1.0F)), static_cast<int>(std::min(v + half_v, v_end - 1.0F)),
          cut};
}

}  // namespace swiftlet::mapping3d
