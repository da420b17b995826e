#include "rendering/overlay3d.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace swiftlet::rendering {
namespace {

using Eigen::Vector3d;

constexpr double kNearest_m = 0.05;
/// Visible and hidden pieces of a line are told apart at this distance.
constexpr double kStep_px = 4.0;
/// A line on a surface is not hidden by it: surfaces are some centimetres thick, and their discs are drawn flat.
constexpr double kThickness_m = 0.06;
constexpr std::uint8_t kHiddenAlpha = 60;
constexpr double kCameraPyramid_m = 0.5;
constexpr double kArrow_m = 0.6, kArrowHead_m = 0.15;
constexpr int kCorners = 24;
/// More lines than this would be a surface: the grid is then coarser.
constexpr double kMostFloorLines = 40.0;

std::vector<Vector3d> ring(const common::Pose3& T_map_ring, double radius_m) {
  std::vector<Vector3d> points_map_m;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle_rad = 2.0 * M_PI * i / kCorners;
    points_map_m.push_back(T_map_ring * Vector3d(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), 0.0));
  }
  return points_map_m;
}

}  // namespace

Overlay3d::Overlay3d(Canvas& canvas, const DepthBuffer& buffer, const Eye& eye, Scheme scheme)
    : canvas_(canvas),
      buffer_(buffer),
      eye_(eye),
      theme_(themeOf(scheme)),
      T_eye_map_(eye.T_map_eye.inverse()),
      scale_(std::max(0.6, std::min(eye.lens.width_px, eye.lens.height_px * 4 / 3) / 640.0)) {}

Overlay3d::Pen Overlay3d::pen(Color color, double width) const {
  return {color, width * scale_, color.withAlpha(kHiddenAlpha), false};
}

void Overlay3d::drawFloor(const Eigen::AlignedBox3d& extent, const common::Pose2& T_map_shown) {
  if (extent.isEmpty()) return;
  const common::Pose2 T_shown_map = T_map_shown.inverse();
  Eigen::AlignedBox2d box_m;
  for (const auto corner : {Eigen::AlignedBox3d::BottomLeftFloor, Eigen::AlignedBox3d::BottomRightFloor,
                            Eigen::AlignedBox3d::TopLeftFloor, Eigen::AlignedBox3d::TopRightFloor})
    box_m.extend(Eigen::Vector2d(T_shown_map * Eigen::Vector2d(extent.corner(corner).head<2>())));
  const Eigen::Vector2d low = box_m.min().array().floor(), high = box_m.max().array().ceil();
  const auto at = [&](double x_m, double y_m) {
    const Eigen::Vector2d point_map_m = T_map_shown * Eigen::Vector2d(x_m, y_m);
    return Vector3d(point_map_m.x(), point_map_m.y(), 0.0);
  };
  const double every_m = std::max(1.0, std::ceil((high - low).maxCoeff() / kMostFloorLines));
  const Pen lines{theme_.grid, 1.0 * scale_, theme_.grid.withAlpha(0)};
  for (double x = low.x(); x <= high.x(); x += every_m) stroke(std::array{at(x, low.y()), at(x, high.y())}, lines);
  for (double y = low.y(); y <= high.y(); y += every_m) stroke(std::array{at(low.x(), y), at(high.x(), y)}, lines);
}

void Overlay3d::drawLine(const Line3d& line) {
  Pen with = line.style == Line3dStyle::kTrail ? pen(theme_.trail, 2.2) : pen(theme_.plan, 2.4);
  with.dashed = line.style == Line3dStyle::kPlan;
  stroke(line.points_map_m, with);
}

void Overlay3d::drawVehicle(const PlacedVehicle& vehicle) {
  const double radius_m = 0.5 * vehicle.hull_diameter_m;
  const Pen hull = pen(theme_.vehicle, 2.2);
  stroke(ring(vehicle.T_map_body, radius_m), hull);
  const auto at = [&](double ahead, double left) {
    return Vector3d(vehicle.T_map_body * (radius_m * Vector3d(ahead, left, 0.0)));
  };
  stroke(std::array{at(0.8, 0.0), at(-0.5, 0.5), at(-0.25, 0.0), at(-0.5, -0.5), at(0.8, 0.0)}, hull);
  const Vector3d center_map_m = vehicle.T_map_body.position_m;
  const Vector3d below_map_m(center_map_m.x(), center_map_m.y(), 0.0);
  stroke(std::array{center_map_m, below_map_m}, pen(theme_.vehicle, 1.0));
}

void Overlay3d::drawTarget(const Vector3d& target_map_m) {
  const auto at = [&](double aside_m, double along_y_m, double above_m) {
    return Vector3d(target_map_m + Vector3d(aside_m, along_y_m, above_m));
  };
  const Vector3d tip = at(0.0, 0.0, 0.0);
  const double side_m = 0.5 * kArrowHead_m;
  const Pen arrow = pen(theme_.goal, 2.6);
  stroke(std::array{at(0.0, 0.0, kArrow_m), tip}, arrow);
  stroke(std::array{at(-side_m, 0.0, kArrowHead_m), tip, at(side_m, 0.0, kArrowHead_m)}, arrow);
  stroke(std::array{at(0.0, -side_m, kArrowHead_m), tip, at(0.0, side_m, kArrowHead_m)}, arrow);
}

void Overlay3d::drawCamera(const PlacedCamera& camera) {
  const double right_px = camera.lens.width_px - 0.5, bottom_px = camera.lens.height_px - 0.5;
  const auto corner = [&](double u_px, double v_px) {
    return Vector3d(camera.T_map_camera * camera.lens.point_camera_m(u_px, v_px, kCameraPyramid_m));
  };
  const std::array corners{corner(-0.5, -0.5), corner(right_px, -0.5), corner(right_px, bottom_px),
                           corner(-0.5, bottom_px)};
  const Pen with = pen(theme_.laser, 1.3);
  for (std::size_t i = 0; i < corners.size(); ++i)
    stroke(std::array{camera.T_map_camera.position_m, corners[i], corners[(i + 1) % corners.size()]}, with);
}

void Overlay3d::stroke(std::span<const Vector3d> points_map_m, const Pen& pen) {
  for (std::size_t i = 1; i < points_map_m.size(); ++i)
    if (const auto piece = clipped({inEye(points_map_m[i - 1]), inEye(points_map_m[i])})) strokePiece(*piece, pen);
}

/// Liang and Barsky's clipping at the planes of the view: inside is where each `distance` is positive.
std::optional<Overlay3d::Piece> Overlay3d::clipped(const Piece& piece) const {
  const common::PinholeCamera& lens = eye_.lens;
  const std::array<Eigen::Vector4d, 5> planes{
      Eigen::Vector4d(1.0, 0.0, 0.0, -kNearest_m), Eigen::Vector4d((lens.cx_px + 0.5) / lens.fx_px, -1.0, 0.0, 0.0),
      Eigen::Vector4d((lens.width_px - 0.5 - lens.cx_px) / lens.fx_px, 1.0, 0.0, 0.0),
      Eigen::Vector4d((lens.cy_px + 0.5) / lens.fy_px, 0.0, -1.0, 0.0),
      Eigen::Vector4d((lens.height_px - 0.5 - lens.cy_px) / lens.fy_px, 0.0, 1.0, 0.0)};
  if (!piece.from_eye_m.allFinite() || !piece.to_eye_m.allFinite()) return std::nullopt;
  double begin = 0.0, end = 1.0;
  for (const Eigen::Vector4d& plane : planes) {
    const double from = plane.dot(piece.from_eye_m.homogeneous()), to = plane.dot(piece.to_eye_m.homogeneous());
    if (from < 0.0 && to < 0.0) return std::nullopt;
    if (from < 0.0) begin = std::max(begin, from / (from - to));
    if (to < 0.0) end = std::min(end, from / (from - to));
  }
  if (begin >= end) return std::nullopt;
  const Vector3d along_m = piece.to_eye_m - piece.from_eye_m;
  return Piece{piece.from_eye_m + begin * along_m, piece.from_eye_m + end * along_m};
}

bool Overlay3d::isHidden(const Vector3d& point_eye_m) const {
  const Eigen::Vector2d pixel = eye_.lens.pixel(point_eye_m);
  const int u = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, buffer_.width_px() - 1);
  const int v = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, buffer_.height_px() - 1);
  return static_cast<double>(buffer_.depth_m(u, v)) + kThickness_m < point_eye_m.x();
}

void Overlay3d::strokePiece(const Piece& piece, const Pen& pen) {
  // Pixel (0, 0) of a lens is the centre of the first pixel; on a canvas it is its corner.
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5);
  const Eigen::Vector2d from = eye_.lens.pixel(piece.from_eye_m) + half, to = eye_.lens.pixel(piece.to_eye_m) + half;
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kStep_px)));
  // Equal steps in the picture are equal steps of the inverse depth.
  const double from_inverse = 1.0 / piece.from_eye_m.x(), to_inverse = 1.0 / piece.to_eye_m.x();
  const auto pointAt = [&](double share) {
    const double inverse = from_inverse + share * (to_inverse - from_inverse);
    const Eigen::Vector2d pixel = from + share * (to - from) - half;
    return eye_.lens.point_camera_m(pixel.x(), pixel.y(), 1.0 / inverse);
  };
  const auto hiddenAt = [&](int step) { return isHidden(pointAt((step + 0.5) / steps)); };
  for (int begin = 0; begin < steps;) {
    const bool hidden = hiddenAt(begin);
    int end = begin + 1;
    while (end < steps && hiddenAt(end) == hidden) ++end;
    const Color color = hidden ? pen.hidden : pen.color;
    const std::array run{Eigen::Vector2d(from + (to - from) * begin / steps),
                         Eigen::Vector2d(from + (to - from) * end / steps)};
    if (color.alpha > 0 && pen.dashed) canvas_.dashedPolyline(run, pen.width_px, 7.0 * scale_, 5.5 * scale_, color);
    if (color.alpha > 0 && !pen.dashed) canvas_.polyline(run, pen.width_px, color);
    begin = end;
  }
}

}  // namespace swiftlet::rendering
