#include "mapping3d/odometry/reference_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mapping3d/odometry/surface_fit.hpp"

namespace swiftlet::mapping3d {
namespace {

/// Cells in a row of the picture, each of which gives up to two points to align later frames to.
constexpr int kPointsAcross = 40;
/// Least gradient of a textured point, in grey levels per pixel.
constexpr double kLeastGradient = 4.0;
/// A surface's plane is fitted to points this near in each direction.
constexpr double kPlaneReach_m = 0.04;
/// What is beside a pixel is read: one pixel for its gradient and depth, at least two for its plane.
constexpr int kBorder_px = 2;
/// Neighbours of a textured point without a plane have its depth within kNeighbourSigmas standard deviations and the
/// share kNeighbourSlope of it.
constexpr double kNeighbourSigmas = 4.0;
constexpr double kNeighbourSlope = 0.02;

double gradientSquared(const vision::GrayImage& gray, int u, int v) {
  const int du = gray.at(u + 1, v) - gray.at(u - 1, v), dv = gray.at(u, v + 1) - gray.at(u, v - 1);
  return 0.25 * (du * du + dv * dv);
}

/// Whether the depth is measured, and is not that of an edge.
bool isReliable(const common::DepthImage& depth, int u, int v, const vision::DepthNoiseConfig& noise) {
  const float here = depth.at(u, v);
  if (!noise.isUsable(here)) return false;
  const auto here_m = static_cast<double>(here);
  const double limit_m = kNeighbourSigmas * noise.sigma_m(here_m) + kNeighbourSlope * here_m;
  for (const float other : {depth.at(u - 1, v), depth.at(u + 1, v), depth.at(u, v - 1), depth.at(u, v + 1)})
    if (!noise.isUsable(other) || std::abs(static_cast<double>(other - here)) > limit_m) return false;
  return true;
}

struct Pixel {
  int u = 0, v = 0;
};

/// The pixel of the greatest gradient in the cell, among those with a reliable depth.
std::optional<Pixel> texturedPixel(const PyramidLevel& level, int left, int top, int right, int bottom,
                                   const vision::DepthNoiseConfig& noise) {
  double greatest = kLeastGradient * kLeastGradient;
  std::optional<Pixel> best;
  for (int v = top; v < bottom; ++v)
    for (int u = left; u < right; ++u)
      if (const double squared = gradientSquared(level.gray, u, v);
          squared > greatest && isReliable(level.depth, u, v, noise)) {
        greatest = squared;
        best = {u, v};
      }
  return best;
}

ReferencePoint pointAt(const PyramidLevel& level, const Pixel& pixel, const std::optional<SurfaceFit>& surface) {
  ReferencePoint point;
  const double depth_m = surface ? surface->depth_m : static_cast<double>(level.depth.at(pixel.u, pixel.v));
  point.point_camera_m = level.camera.point_camera_m(pixel.u, pixel.v, depth_m).cast<float>();
  if (surface) point.normal_camera = surface->normal_camera.cast<float>();
  point.gray = static_cast<float>(level.gray.at(pixel.u, pixel.v));
  return point;
}

}  // namespace

std::vector<ReferencePoint> referencePoints(const PyramidLevel& level, const vision::DepthNoiseConfig& noise) {
  const int width_px = level.camera.width_px, height_px = level.camera.height_px;
  const int cell_px = std::max(1, width_px / kPointsAcross);
  const auto surfaceAt = [&](const Pixel& pixel) {
    const auto depth_m = static_cast<double>(level.depth.at(pixel.u, pixel.v));
    const double reach_px = depth_m > 0.0 ? kPlaneReach_m * level.camera.fx_px / depth_m : 0.0;
    return fitSurface(level.depth, level.camera, pixel.u, pixel.v, static_cast<int>(std::clamp(reach_px, 2.0, 8.0)),
                      noise);
  };
  std::vector<ReferencePoint> points;
  for (int top = kBorder_px; top < height_px - kBorder_px; top += cell_px)
    for (int left = kBorder_px; left < width_px - kBorder_px; left += cell_px) {
      const int right = std::min(left + cell_px, width_px - kBorder_px);
      const int bottom = std::min(top + cell_px, height_px - kBorder_px);
      const auto textured = texturedPixel(level, left, top, right, bottom, noise);
      if (textured) {
        points.push_back(pointAt(level, *textured, surfaceAt(*textured)));
        points.back().is_textured = true;
      }
      const Pixel middle{(left + right) / 2, (top + bottom) / 2};
      if (textured && textured->u == middle.u && textured->v == middle.v) continue;
      if (const auto surface = surfaceAt(middle)) points.push_back(pointAt(level, middle, surface));
    }
  points.shrink_to_fit();  // They are kept as long as their key frame.
  return points;
}

}  // namespace swiftlet::mapping3d
