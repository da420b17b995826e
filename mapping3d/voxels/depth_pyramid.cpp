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

}  // namespace

DepthPyramid::DepthPyramid(Of of, int side_max)
    : of_(of), levels_(static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(side_max)))) {}

void DepthPyramid::build(const std::vector<float>& image_m, int width_px, int height_px) {
  width_px_ = width_px;
  levels_.front() = image_m;
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    const int half = 1 << (level - 1);
    if (of_ == Of::kLeast)
      makeCoarser(
          levels_[level - 1], width_px, height_px, half, [](float a, float b) { return a < b ? a : b; },
          levels_[level]);
    else
      makeCoarser(
          levels_[level - 1], width_px, height_px, half, [](float a, float b) { return a > b ? a : b; },
          levels_[level]);
  }
}

}  // namespace swiftlet::mapping3d
