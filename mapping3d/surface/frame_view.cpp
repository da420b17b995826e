#include "mapping3d/surface/frame_view.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "common/row_major.hpp"

namespace swiftlet::mapping3d {
namespace {

/// A block of 2 cm voxels at 2 m covers some 40 pixels of a VGA image.
constexpr int kTile_px = 16;

}  // namespace

FrameView::FrameView(const common::RgbdFrame& frame, double half_side_m, double range_m, double behind_m)
    : camera_(frame.camera),
      radius_m_(static_cast<float>(std::numbers::sqrt3 * half_side_m)),
      range_m_(static_cast<float>(range_m)),
      behind_m_(static_cast<float>(behind_m)),
      columns_((camera_.width_px + kTile_px - 1) / kTile_px),
      rows_((camera_.height_px + kTile_px - 1) / kTile_px),
      tiles_m_(common::rowMajor(rows_, columns_, 0), 0.0F) {
  const double right_px = camera_.width_px - 1 - camera_.cx_px, below_px = camera_.height_px - 1 - camera_.cy_px;
  sides_ = {Eigen::Vector3d(camera_.cx_px, -camera_.fx_px, 0.0).normalized().cast<float>(),
            Eigen::Vector3d(right_px, camera_.fx_px, 0.0).normalized().cast<float>(),
            Eigen::Vector3d(camera_.cy_px, 0.0, -camera_.fy_px).normalized().cast<float>(),
            Eigen::Vector3d(below_px, 0.0, camera_.fy_px).normalized().cast<float>()};
  std::size_t pixel = 0;
  for (int v = 0; v < camera_.height_px; ++v)
    for (int u = 0; u < camera_.width_px; ++u, ++pixel) {
      float& tile_m = tiles_m_[common::rowMajor(v / kTile_px, columns_, u / kTile_px)];
      tile_m = std::max(tile_m, std::min(frame.depth.depth_m[pixel], range_m_));
    }
}

bool FrameView::sees(const Eigen::Vector3f& middle_camera_m) const {
  const float nearest_m = middle_camera_m.x() - radius_m_;
  if (nearest_m > range_m_ + behind_m_) return false;
  if (std::any_of(sides_.begin(), sides_.end(),
                  [&](const Eigen::Vector3f& side) { return side.dot(middle_camera_m) < -radius_m_; }))
    return false;
  // Around the camera itself a block may cover any pixel.
  if (nearest_m <= 0.0F) return middle_camera_m.x() + radius_m_ > 0.0F;
  return nearest_m <= farthestDepth_m(middle_camera_m) + behind_m_;
}

float FrameView::farthestDepth_m(const Eigen::Vector3f& middle_camera_m) const {
  // The corners of a box around the block project into this rectangle, a pixel wider for depths between pixels.
  const float near_m = middle_camera_m.x() - radius_m_, far_m = middle_camera_m.x() + radius_m_;
  const auto tilesOf = [&](double center_px, double focal_px, float aside_m, int count) {
    const float high_m = aside_m + radius_m_, low_m = aside_m - radius_m_;
    const auto tile = [&](float offset, float depth_m, float margin_px) {
      const float pixel = static_cast<float>(center_px) - static_cast<float>(focal_px) * offset / depth_m + margin_px;
      const float last = static_cast<float>(count - 1);
      return static_cast<int>(std::clamp(pixel / static_cast<float>(kTile_px), 0.0F, last));
    };
    return std::pair(tile(high_m, high_m > 0.0F ? near_m : far_m, -1.0F),
                     tile(low_m, low_m > 0.0F ? far_m : near_m, 1.0F));
  };
  const auto [left, right] = tilesOf(camera_.cx_px, camera_.fx_px, middle_camera_m.y(), columns_);
  const auto [top, bottom] = tilesOf(camera_.cy_px, camera_.fy_px, middle_camera_m.z(), rows_);
  float farthest_m = 0.0F;
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column)
      farthest_m = std::max(farthest_m, tiles_m_[common::rowMajor(row, columns_, column)]);
  return farthest_m;
}

}  // namespace swiftlet::mapping3d
