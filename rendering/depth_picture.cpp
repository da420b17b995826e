#include "rendering/depth_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/check.hpp"
#include "rendering/canvas.hpp"

namespace swiftlet::rendering {
namespace {

double bump(double x, double center) {
  const double t = std::clamp(1.5 - std::abs(4.0 * x - center), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

Color colorOf(float depth_m) {
  if (common::isMeasured(depth_m)) return depthColor(static_cast<double>(depth_m));
  return depth_m == common::DepthImage::kTooFar ? kTooFarDepth : kUnknownDepth;
}

/// A bar of the colours with the depths at its ends.
void drawScale(Canvas& canvas) {
  const double width = canvas.width_px(), height_px = std::max(6.0, width / 40.0),
               bottom = canvas.height_px() - height_px;
  const double x0 = 0.5 * width, x1 = 0.85 * width;
  const Color text = rgb(0xffffff), halo = rgb(0x000000).withAlpha(160);
  for (double x = x0; x < x1; x += 1.0) {
    const double share = (x - x0) / (x1 - x0);
    canvas.fillRect(x, bottom - 0.7 * height_px, x + 1.0, bottom,
                    depthColor(kNearestDepthShown_m + share * (kFarthestDepthShown_m - kNearestDepthShown_m)));
  }
  canvas.text(fmt::format("{:g} m", kNearestDepthShown_m), {x0 - 3.0 * height_px, bottom}, height_px, text,
              Align::kCenter, halo);
  canvas.text(fmt::format("{:g} m", kFarthestDepthShown_m), {x1 + 3.0 * height_px, bottom}, height_px, text,
              Align::kCenter, halo);
}

}  // namespace

Color depthColor(double depth_m) {
  const double x =
      std::clamp((kFarthestDepthShown_m - depth_m) / (kFarthestDepthShown_m - kNearestDepthShown_m), 0.0, 1.0);
  const auto channel = [x](double center) { return static_cast<std::uint8_t>(std::lround(255.0 * bump(x, center))); };
  return {channel(3.0), channel(2.0), channel(1.0)};
}

common::Image depthPicture(const common::DepthImage& depth, int width_px) {
  SWIFTLET_CHECK(width_px > 0 && depth.width_px > 0 && depth.height_px > 0, width_px);
  SWIFTLET_CHECK(depth.depth_m.size() ==
                 static_cast<std::size_t>(depth.width_px) * static_cast<std::size_t>(depth.height_px));
  const int width = std::min(width_px, depth.width_px);
  const int height = std::max(1, static_cast<int>(static_cast<long>(depth.height_px) * width / depth.width_px));
  common::Image image{width, height, {}};
  image.rgb.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Color color = colorOf(depth.at(static_cast<int>((2L * u + 1) * depth.width_px / (2L * width)),
                                           static_cast<int>((2L * v + 1) * depth.height_px / (2L * height))));
      image.rgb.insert(image.rgb.end(), {color.red, color.green, color.blue});
    }
  Canvas canvas(std::move(image));
  drawScale(canvas);
  return canvas.take();
}

}  // namespace swiftlet::rendering
