#include "mapping3d/voxels/depth_pyramid.hpp"

namespace swiftlet::mapping3d {
namespace {

/// Squares of twice the side: each from four of the finer level.
template <typename MoreExtreme>
void makeCoarser(const std::vector<float>& finer, int width_px, int height_px, int half, MoreExtreme extreme,
                 std::vector<float>& coarser) {
  coarser.resize(finer.size());
  const int whole = std::max(0, width_px - half);
  for (int v = 0; v < height_px; ++v) {
    const float* upper = &finer[static_cast<std::size_t>(v * width_px)];
    const float* lower = &finer[static_cast<std::size_t>(std::min(v + half, height_px - 1) * width_px)];
    float* out = &coarser[static_cast<std::size_t>(v * width_px)];
    for (int u = 0; u < whole; ++u)
      out[u] = extreme(extreme(upper[u], upper[u + half]), extreme(lower[u], lower[u + half]));
    for (int u = whole; u < width_px; ++u) out[u] = extreme(upper[u], lower[u]);
  }
}

/// Each square of two by two pixels as one; at odd edges there are fewer of them.
template <typename MoreExtreme>
void makeGroups(const std::vector<float>& image, int width_px, int height_px, MoreExtreme extreme,
                std::vector<float>& groups) {
  const int width = (width_px + 1) / 2, height = (height_px + 1) / 2, whole = width_px / 2;
  groups.resize(static_cast<std::size_t>(width * height));
  for (int v = 0; v < height; ++v) {
    const float* upper = &image[static_cast<std::size_t>(2 * v * width_px)];
    const float* lower = &image[static_cast<std::size_t>(std::min(2 * v + 1, height_px - 1) * width_px)];
    float* out = &groups[static_cast<std::size_t>(v * width)];
    for (int u = 0; u < whole; ++u)
      out[u] = extreme(extreme(upper[2 * u], upper[2 * u + 1]), extreme(lower[2 * u], lower[2 * u + 1]));
    if (whole < width) out[whole] = extreme(upper[2 * whole], lower[2 * whole]);
  }
}

}  // namespace

DepthPyramid::DepthPyramid(Of of, int side_max)
    : of_(of), levels_(static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(side_max)))) {}

void DepthPyramid::build(const std::vector<float>& image_m, int width_px, int height_px, int group_px) {
  if (of_ == Of::kLeast)
    buildWith(image_m, width_px, height_px, group_px, [](float a, float b) { return a < b ? a : b; });
  else
    buildWith(image_m, width_px, height_px, group_px, [](float a, float b) { return a > b ? a : b; });
}

template <typename MoreExtreme>
void DepthPyramid::buildWith(const std::vector<float>& image_m, int width_px, int height_px, int group_px,
                             MoreExtreme extreme) {
  width_px_ = (width_px + group_px - 1) / group_px;
  const int height = (height_px + group_px - 1) / group_px;
  if (group_px == 1)
    levels_.front() = image_m;
  else
    makeGroups(image_m, width_px, height_px, extreme, levels_.front());
  for (std::size_t level = 1; level < levels_.size(); ++level)
    makeCoarser(levels_[level - 1], width_px_, height, 1 << (level - 1), extreme, levels_[level]);
}

}  // namespace swiftlet::mapping3d
