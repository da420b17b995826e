#include "mapping3d/surface/tsdf_volume.hpp"

#include <algorithm>
#include <cmath>

#include "common/check.hpp"
#include "common/row_major.hpp"
#include "mapping3d/surface/depth_between.hpp"
#include "mapping3d/surface/frame_view.hpp"
#include "mapping3d/voxels/ray_walk.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;
using common::RgbdFrame;
using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::Vector3i;

/// The distance is truncated at this many voxels, as in voxblox (Oleynikova et al. 2017) and about as in Open3D: four
/// voxels on each side of a surface define it also where frames disagree by two.
constexpr double kTruncationVoxels = 4.0;
/// And at not less than three standard deviations of the depth: a measurement must not end before the surface.
constexpr double kTruncationSigmas = 3.0;
/// Surfaces whose noise is greater than this many voxels are not resolved by them. With the line above it bounds the
/// truncation at six voxels.
constexpr double kNoiseVoxels = 2.0;

double truncation_m(const TsdfConfig& config, double depth_m) {
  return std::max(kTruncationVoxels * config.resolution_m, kTruncationSigmas * config.noise.sigma_m(depth_m));
}

/// The frame as the voxels see it.
class Projector {
 public:
  Projector(const RgbdFrame& frame, const TsdfConfig& config, double range_m)
      : frame_(frame),
        config_(config),
        range_m_(static_cast<float>(range_m)),
        // Nothing finer than a voxel is told apart: the variance of a place within one.
        least_variance_m2_(static_cast<float>(config.resolution_m * config.resolution_m / 12.0)) {}

  /// Draws what the frame says about a voxel there.
  void draw(const Vector3f& point_camera_m, TsdfVoxel& voxel) const {
    if (point_camera_m.x() <= 0.0F) return;
    const common::PinholeCamera& camera = frame_.camera;
    const float per_depth = 1.0F / point_camera_m.x();
    const float u =
        static_cast<float>(camera.cx_px) - static_cast<float>(camera.fx_px) * point_camera_m.y() * per_depth;
    const float v =
        static_cast<float>(camera.cy_px) - static_cast<float>(camera.fy_px) * point_camera_m.z() * per_depth;
    const float seen_m = depthBetween(frame_.depth, camera, config_.noise, u, v);
    if (seen_m == common::DepthImage::kUnknown) return;
    const float depth_m = std::min(seen_m, range_m_);
    const auto truncated_m = static_cast<float>(truncation_m(config_, static_cast<double>(depth_m)));
    const float ray_per_depth = point_camera_m.norm() * per_depth;
    const float distance_m = (depth_m - point_camera_m.x()) * ray_per_depth;
    // Beyond the range the ray is free up to there, and nothing is behind.
    if (distance_m < (seen_m > range_m_ ? truncated_m : -truncated_m)) return;
    const auto sigma_m = static_cast<float>(config_.noise.sigma_m(static_cast<double>(depth_m)));
    const float weight = behindWeight(distance_m, truncated_m) / (sigma_m * sigma_m + least_variance_m2_);
    if (weight <= 0.0F) return;
    const float share = weight / (voxel.weight_1_m2 + weight);
    voxel.weight_1_m2 += weight;
    voxel.distance_m += share * (std::min(distance_m, truncated_m) - voxel.distance_m);
    if (distance_m < truncated_m) blend(u, v, share, voxel);
  }

 private:
  /// Behind its first voxel a surface is less and less certain: a thin wall is also seen from its other side, and the
  /// two must not erase each other (Bylow et al. 2013, the linear weight).
  float behindWeight(float distance_m, float truncated_m) const {
    const auto voxel_m = static_cast<float>(config_.resolution_m);
    return distance_m >= -voxel_m ? 1.0F : (truncated_m + distance_m) / (truncated_m - voxel_m);
  }

  void blend(float u, float v, float share, TsdfVoxel& voxel) const {
    const std::size_t pixel =
        3 * common::rowMajor(static_cast<int>(std::lround(v)), frame_.color.width_px, static_cast<int>(std::lround(u)));
    for (std::size_t i = 0; i < 3; ++i) {
      const float before = voxel.rgb[i], seen = frame_.color.rgb[pixel + i];
      voxel.rgb[i] = voxel.has_color ? static_cast<std::uint8_t>(before + share * (seen - before) + 0.5F)
                                     : frame_.color.rgb[pixel + i];
    }
    voxel.has_color = true;
  }

  const RgbdFrame& frame_;
  const TsdfConfig& config_;
  float range_m_;
  float least_variance_m2_;
};

/// One pixel in so many across and down makes blocks: of rays half a voxel apart, one meets each voxel that a surface
/// touches, also the one in the corner of a block.
int pixelStep(double resolution_m, double pixel_m) {
  constexpr int kMostPixels = 16;
  int step = 1;
  while (step < kMostPixels && 4 * step * pixel_m <= resolution_m) step *= 2;
  return step;
}

}  // namespace

TsdfVolume::TsdfVolume(const TsdfConfig& config)
    : config_(config),
      range_m_(
          std::min(config.range_max_m, std::sqrt(kNoiseVoxels * config.resolution_m / config.noise.sigma_per_m2))) {}

void TsdfVolume::integrate(const RgbdFrame& frame, const Pose3& T_map_camera) {
  const auto pixels = static_cast<std::size_t>(frame.camera.pixels());
  SWIFTLET_CHECK(frame.color.rgb.size() == 3 * pixels && frame.depth.depth_m.size() == pixels);
  makeBlocks(frame, T_map_camera);
  const FrameView view(frame, 0.5 * VoxelBlock::kSide * config_.resolution_m, range_m_,
                       truncation_m(config_, range_m_));
  const Projector projector(frame, config_, range_m_);
  const Pose3 T_camera_map = T_map_camera.inverse();
  const Eigen::Matrix3d rotation = T_camera_map.rotation.toRotationMatrix();
  const Eigen::Matrix3f step = (config_.resolution_m * rotation).cast<float>();
  for (auto& [index, block] : blocks_) {
    const VoxelIndex first = VoxelMap::firstOf(index);
    const Vector3d corner_m =
        rotation * (Vector3d(first.x + 0.5, first.y + 0.5, first.z + 0.5) * config_.resolution_m) +
        T_camera_map.position_m;
    const Vector3f origin_m = corner_m.cast<float>();
    if (!view.sees(origin_m + step * Vector3f::Constant(0.5F * (VoxelBlock::kSide - 1)))) continue;
    for (int offset = 0; offset < VoxelBlock::kVoxels; ++offset) {
      const VoxelIndex at = VoxelMap::voxelOf({}, offset);
      projector.draw(origin_m + step * Vector3i(at.x, at.y, at.z).cast<float>(),
                     block->voxels[static_cast<std::size_t>(offset)]);
    }
  }
}

void TsdfVolume::makeBlocks(const RgbdFrame& frame, const Pose3& T_map_camera) {
  const Eigen::Matrix3d rotation = T_map_camera.rotation.toRotationMatrix();
  std::size_t pixel = 0;
  for (int v = 0; v < frame.camera.height_px; ++v)
    for (int u = 0; u < frame.camera.width_px; ++u, ++pixel) {
      const double depth_m = frame.depth.depth_m[pixel];
      if (!common::isMeasured(frame.depth.depth_m[pixel]) || depth_m > range_m_) continue;
      const int step = pixelStep(config_.resolution_m, depth_m / frame.camera.fx_px);
      if (u % step != 0 || v % step != 0) continue;
      const Vector3d ray = rotation * frame.camera.point_camera_m(u, v, 1.0);
      const double half_m = truncation_m(config_, depth_m) / ray.norm();
      makeBlocksAlong(T_map_camera.position_m + (depth_m - half_m) * ray,
                      T_map_camera.position_m + (depth_m + half_m) * ray);
    }
}

void TsdfVolume::makeBlocksAlong(const Vector3d& from_map_m, const Vector3d& to_map_m) {
  const double side_m = VoxelBlock::kSide * config_.resolution_m;
  for (RayWalk walk(from_map_m / side_m, to_map_m / side_m);; walk.advance()) {
    if (!blocks_.contains(walk.cell())) {
      is_full_ = is_full_ || blocks_.size() >= config_.blocks_max;
      if (!is_full_) blocks_.emplace(walk.cell(), std::make_unique<TsdfBlock>());
    }
    if (walk.atEnd()) return;
  }
}

std::vector<VoxelIndex> TsdfVolume::blocks() const {
  std::vector<VoxelIndex> indices;
  indices.reserve(blocks_.size());
  for (const auto& [index, block] : blocks_) indices.push_back(index);
  std::sort(indices.begin(), indices.end());
  return indices;
}

const TsdfBlock* TsdfVolume::block(VoxelIndex index) const {
  const auto found = blocks_.find(index);
  return found == blocks_.end() ? nullptr : found->second.get();
}

}  // namespace swiftlet::mapping3d
