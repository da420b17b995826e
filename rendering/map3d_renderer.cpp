#include "rendering/map3d_renderer.hpp"

#include <algorithm>
#include <array>

#include "common/check.hpp"
#include "rendering/canvas.hpp"
#include "rendering/overlay3d.hpp"

namespace swiftlet::rendering {
namespace {

/// Eye-dome lighting (Boucheny 2009): a pixel is darker the more its neighbours are in front of it. Depths are compared
/// relative to the pixel's own, and a sum of 1 / kShade halves the brightness.
constexpr float kShade = 6.0F;
/// Relative depths below this are noise of the map: 1 cm at 1 m.
constexpr float kDepthNoise = 0.01F;
constexpr int kNeighbour_px = 1;

/// From 0 (dark) to 256.
int brightness(const DepthBuffer& buffer, int u_px, int v_px) {
  const float depth_m = buffer.depth_m(u_px, v_px);
  const auto before = [&](int u, int v) { return std::max(0.0F, 1.0F - kDepthNoise - buffer.depth_m(u, v) / depth_m); };
  const float sum = before(std::max(0, u_px - kNeighbour_px), v_px) +
                    before(std::min(buffer.width_px() - 1, u_px + kNeighbour_px), v_px) +
                    before(u_px, std::max(0, v_px - kNeighbour_px)) +
                    before(u_px, std::min(buffer.height_px() - 1, v_px + kNeighbour_px));
  return static_cast<int>(256.0F / (1.0F + kShade * sum));
}

common::Image shaded(const DepthBuffer& buffer, Color background) {
  common::Image image{buffer.width_px(), buffer.height_px(), {}};
  image.rgb.resize(3 * static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px));
  std::uint8_t* pixel = image.rgb.data();
  for (int v = 0; v < image.height_px; ++v)
    for (int u = 0; u < image.width_px; ++u, pixel += 3) {
      if (buffer.isEmpty(u, v)) {
        pixel[0] = background.red;
        pixel[1] = background.green;
        pixel[2] = background.blue;
        continue;
      }
      const auto light = static_cast<std::uint32_t>(brightness(buffer, u, v));
      const std::uint32_t rgb = buffer.rgb(u, v);
      for (int i = 0; i < 3; ++i) pixel[i] = static_cast<std::uint8_t>(((rgb >> (16 - 8 * i)) & 255U) * light >> 8);
    }
  return image;
}

}  // namespace

common::Image Map3dRenderer::render(const Picture3d& picture, const Map3dView& view) {
  SWIFTLET_CHECK(view.width_px >= 16 && view.width_px <= 8192 && view.height_px >= 16 && view.height_px <= 8192,
                 view.width_px, view.height_px);
  const Eye eye = eyeOf(view.viewpoint, picture, view.width_px, view.height_px);
  const DepthBuffer& buffer = surfaces_.draw(picture.surfaces, eye, view.coloring);
  Canvas canvas(shaded(buffer, themeOf(view.scheme).behind_3d));
  Overlay3d overlay(canvas, buffer, eye, view.scheme);
  overlay.drawFloor(extentOf(picture), picture.shown.T_map_shown);
  for (const Line3d& line : picture.lines) overlay.drawLine(line);
  for (const Eigen::Vector3d& target_map_m : picture.targets_map_m) overlay.drawTarget(target_map_m);
  if (picture.camera && view.viewpoint.kind != Viewpoint3d::Kind::kCamera) overlay.drawCamera(*picture.camera);
  if (picture.vehicle && view.viewpoint.kind != Viewpoint3d::Kind::kCamera) overlay.drawVehicle(*picture.vehicle);
  return canvas.take();
}

common::Image renderMap3d(const Picture3d& picture, const Map3dView& view) {
  return Map3dRenderer().render(picture, view);
}

}  // namespace swiftlet::rendering
