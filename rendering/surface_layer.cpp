#include "rendering/surface_layer.hpp"

#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace swiftlet::rendering {
namespace {

using Eigen::Vector3f;

/// The 3D map keeps one point in a cube. Neighbours are then up to the cube's diagonal apart, which a disc of this many
/// times the side bridges.
constexpr double kDiscDiameter = 1.75;
/// Nearer points are not drawn: their discs would fill the picture.
constexpr float kNearest_m = 0.05F;
/// Of the discs of small cubes, and of any.
constexpr int kMostFineRadius_px = 16, kMostRadius_px = 64;

/// Half the width of each row of a disc, by the radius in half pixels.
class DiscTable {
 public:
  DiscTable() {
    for (int twice = 0; twice <= 2 * kMostRadius_px; ++twice)
      for (int row = 0; 2 * row <= twice; ++row) {
        const double radius = 0.5 * twice;
        half_widths_[index(twice, row)] = static_cast<std::int8_t>(std::sqrt(radius * radius - row * row));
      }
  }
  int halfWidth(int twice_radius_px, int row) const { return half_widths_[index(twice_radius_px, row)]; }

 private:
  static std::size_t index(int twice, int row) {
    return static_cast<std::size_t>(twice) * (kMostRadius_px + 1) + static_cast<std::size_t>(row);
  }
  std::array<std::int8_t, std::size_t{2 * kMostRadius_px + 1} * (kMostRadius_px + 1)> half_widths_{};
};

void drawDisc(int u_px, int v_px, int twice_radius_px, std::uint64_t key, DepthBuffer& buffer) {
  static const DiscTable kDiscs;
  const int radius_px = twice_radius_px / 2;
  for (int row = -radius_px; row <= radius_px; ++row) {
    const int v = v_px + row;
    if (v < 0 || v >= buffer.height_px()) continue;
    const int half = kDiscs.halfWidth(twice_radius_px, std::abs(row));
    buffer.drawSpan(v, std::max(0, u_px - half), std::min(buffer.width_px(), u_px + half + 1), key);
  }
}

std::uint32_t packed(const std::array<std::uint8_t, 3>& rgb) {
  return static_cast<std::uint32_t>(rgb[0] << 16 | rgb[1] << 8 | rgb[2]);
}

/// Each component from -1 to 1 becomes a channel from 0 to 255; unknown directions become grey.
std::uint32_t colorOfNormal(const Vector3f& normal_map) {
  const auto channel = [](float component) {
    return static_cast<std::uint32_t>(std::lround(127.5F * (1.0F + std::min(1.0F, std::max(-1.0F, component)))));
  };
  return channel(normal_map.x()) << 16 | channel(normal_map.y()) << 8 | channel(normal_map.z());
}

bool samePose(const common::Pose3& a, const common::Pose3& b) {
  return a.position_m == b.position_m && a.rotation.coeffs() == b.rotation.coeffs();
}

bool sameLens(const common::PinholeCamera& a, const common::PinholeCamera& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px && a.fx_px == b.fx_px && a.fy_px == b.fy_px &&
         a.cx_px == b.cx_px && a.cy_px == b.cy_px;
}

}  // namespace

void drawSurface(const PlacedSurface& surface, const Eye& eye, PointColor coloring, DepthBuffer& buffer) {
  const common::Pose3 T_eye_points = eye.T_map_eye.inverse() * surface.T_map_points;
  const Eigen::Matrix3f rotation = T_eye_points.rotation.toRotationMatrix().cast<float>();
  const Vector3f offset_m = T_eye_points.position_m.cast<float>();
  const Vector3f eye_points_m = T_eye_points.inverse().position_m.cast<float>();
  const Eigen::Matrix3f map_rotation = surface.T_map_points.rotation.toRotationMatrix().cast<float>();
  const auto fx = static_cast<float>(eye.lens.fx_px), fy = static_cast<float>(eye.lens.fy_px);
  const auto cx = static_cast<float>(eye.lens.cx_px), cy = static_cast<float>(eye.lens.cy_px);
  const auto right_px = static_cast<float>(buffer.width_px() + kMostRadius_px);
  const auto bottom_px = static_cast<float>(buffer.height_px() + kMostRadius_px);
  const double fine_m = kDiscDiameter * surface.cube_m, coarse_m = common::kLargeCube * fine_m;
  const std::size_t fine = surface.points->size() - surface.coarse;
  for (std::size_t i = 0; i < surface.points->size(); ++i) {
    const common::SurfacePoint& point = (*surface.points)[i];
    const auto disc_m = static_cast<float>(i < fine ? fine_m : coarse_m);
    const int most_px = 2 * (i < fine ? kMostFineRadius_px : kMostRadius_px);
    if ((point.position_m - eye_points_m).dot(point.normal) > 0.0F) continue;
    const Vector3f at_m = rotation * point.position_m + offset_m;
    if (!(at_m.x() > kNearest_m)) continue;
    const float per_depth = 1.0F / at_m.x();
    const float u = cx - fx * at_m.y() * per_depth, v = cy - fy * at_m.z() * per_depth;
    if (!(u > -kMostRadius_px && v > -kMostRadius_px && u < right_px && v < bottom_px)) continue;
    const int twice_radius_px = std::min(most_px, static_cast<int>(std::ceil(disc_m * fy * per_depth)));
    const std::uint32_t rgb =
        coloring == PointColor::kMeasured ? packed(point.rgb) : colorOfNormal(map_rotation * point.normal);
    drawDisc(static_cast<int>(std::floor(u + 0.5F)), static_cast<int>(std::floor(v + 0.5F)), twice_radius_px,
             DepthBuffer::keyOf(at_m.x(), rgb), buffer);
  }
}

bool SurfaceLayer::fits(const std::vector<PlacedSurface>& surfaces, const Eye& eye, PointColor coloring) const {
  if (coloring != coloring_ || !samePose(eye.T_map_eye, eye_.T_map_eye) || !sameLens(eye.lens, eye_.lens)) return false;
  if (drawn_.size() + 1 > surfaces.size()) return false;
  for (std::size_t i = 0; i < drawn_.size(); ++i)
    if (drawn_[i].points != surfaces[i].points || !samePose(drawn_[i].T_map_points, surfaces[i].T_map_points))
      return false;
  return true;
}

const DepthBuffer& SurfaceLayer::draw(const std::vector<PlacedSurface>& surfaces, const Eye& eye, PointColor coloring) {
  if (!fits(surfaces, eye, coloring)) {
    drawn_.clear();
    settled_ = DepthBuffer(eye.lens.width_px, eye.lens.height_px);
    eye_ = eye;
    coloring_ = coloring;
  }
  for (std::size_t i = drawn_.size(); i + 1 < surfaces.size(); ++i) {
    drawSurface(surfaces[i], eye, coloring, settled_);
    drawn_.push_back(surfaces[i]);
  }
  all_ = settled_;
  if (!surfaces.empty()) drawSurface(surfaces.back(), eye, coloring, all_);
  return all_;
}

}  // namespace swiftlet::rendering
