#include "perception/targets/colored_blobs.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::perception {
namespace {

/// Depths of neighbours on one thing differ by less: a surface at 80 degrees changes by 6 % of its depth from pixel to
/// pixel of a camera with 0.2 degrees a pixel.
constexpr float kStep_m = 0.08F, kStepShare = 0.03F;

/// The class of each pixel with a measured depth.
std::vector<std::uint8_t> classified(const common::RgbdFrame& frame, const ColorClasses& classes) {
  std::vector<std::uint8_t> colors(frame.depth.depth_m.size(), ColorClasses::kNone);
  const std::uint8_t* byte = frame.color.rgb.data();
  for (std::size_t i = 0; i < colors.size(); ++i, byte += 3)
    if (common::isMeasured(frame.depth.depth_m[i])) colors[i] = classes.of(byte[0], byte[1], byte[2]);
  return colors;
}

bool isOneSurface(float a_m, float b_m) { return std::abs(a_m - b_m) < std::max(kStep_m, kStepShare * a_m); }

}  // namespace

std::vector<ColoredBlob> coloredBlobs(const common::RgbdFrame& frame, const ColorClasses& classes, int pixels_min) {
  std::vector<std::uint8_t> colors = classified(frame, classes);
  const int width = frame.camera.width_px, height = frame.camera.height_px;
  const std::vector<float>& depth_m = frame.depth.depth_m;
  std::vector<ColoredBlob> blobs;
  for (int first = 0; first < width * height; ++first) {
    const std::uint8_t color = colors[static_cast<std::size_t>(first)];
    if (color == ColorClasses::kNone) continue;
    ColoredBlob blob{color, {first}, first % width, first % width, first / width, first / width};
    colors[static_cast<std::size_t>(first)] = ColorClasses::kNone;  // Each pixel is taken once.
    for (std::size_t next = 0; next < blob.pixels.size(); ++next) {
      const int pixel = blob.pixels[next], u = pixel % width, v = pixel / width;
      blob.left = std::min(blob.left, u);
      blob.right = std::max(blob.right, u);
      blob.top = std::min(blob.top, v);
      blob.bottom = std::max(blob.bottom, v);
      const auto visit = [&](bool inside, int neighbour) {
        if (!inside || colors[static_cast<std::size_t>(neighbour)] != color) return;
        if (!isOneSurface(depth_m[static_cast<std::size_t>(pixel)], depth_m[static_cast<std::size_t>(neighbour)]))
          return;
        colors[static_cast<std::size_t>(neighbour)] = ColorClasses::kNone;
        blob.pixels.push_back(neighbour);
      };
      visit(u > 0, pixel - 1);
      visit(u + 1 < width, pixel + 1);
      visit(v > 0, pixel - width);
      visit(v + 1 < height, pixel + width);
    }
    if (static_cast<int>(blob.pixels.size()) < pixels_min) continue;
    std::sort(blob.pixels.begin(), blob.pixels.end());
    blobs.push_back(std::move(blob));
  }
  return blobs;
}

}  // namespace swiftlet::perception
