#include "rendering/viewpoint3d.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

namespace swiftlet::rendering {
namespace {

using Eigen::Vector3d;

/// Vertical field of view, the usual one of 3D viewers (three.js).
constexpr double kFieldOfView_rad = 50.0 * common::kRadPerDeg;
/// Number of points that are sampled for the extent of everything.
constexpr std::size_t kExtentSamples = 5000;
/// The whole picture shows at least a cube of twice this side, so that a first small surface does not fill it.
constexpr double kSmallestHalf_m = 1.0;
/// A border around the whole, of the distance.
constexpr double kMargin = 1.04;
/// The share of points that count for the extent: single wrong points must not shrink the map to a dot.
constexpr double kShare = 0.99;

common::PinholeCamera lensOf(double focal_px, int width_px, int height_px) {
  return {width_px, height_px, focal_px, focal_px, 0.5 * (width_px - 1), 0.5 * (height_px - 1)};
}

std::vector<Vector3d> samplesOf(const Picture3d& picture) {
  std::size_t total = 0;
  for (const PlacedSurface& surface : picture.surfaces) total += surface.points->size();
  const std::size_t step = total / kExtentSamples + 1;
  std::vector<Vector3d> samples_map_m;
  for (const PlacedSurface& surface : picture.surfaces)
    for (std::size_t i = 0; i < surface.points->size(); i += step) {
      const Vector3d point_map_m = surface.T_map_points * (*surface.points)[i].position_m.cast<double>().eval();
      if (point_map_m.allFinite()) samples_map_m.push_back(point_map_m);
    }
  if (picture.vehicle && common::isFinite(picture.vehicle->T_map_body))
    samples_map_m.push_back(picture.vehicle->T_map_body.position_m);
  return samples_map_m;
}

/// Of an eye that looks at the target.
common::Pose3 lookingAt(const Vector3d& target_map_m, const Viewpoint3d& from, double distance_m) {
  // The view goes down by the elevation, which is a pitch forward about the y axis (left).
  const Eigen::Quaterniond rotation = common::quaternionFrom({0.0, from.elevation_rad, from.azimuth_rad + M_PI});
  return {rotation, target_map_m - distance_m * (rotation * Vector3d::UnitX())};
}

/// The extent, made larger where it is small.
Eigen::AlignedBox3d shownBox(const Picture3d& picture) {
  Eigen::AlignedBox3d box = extentOf(picture);
  if (box.isEmpty()) box = Eigen::AlignedBox3d(Vector3d::Zero());
  const Vector3d half = Vector3d::Constant(kSmallestHalf_m), center = box.center();
  return box.extend(Vector3d(center - half)).extend(Vector3d(center + half));
}

/// From the middle of the box, so that all its corners are in the picture. `across` and `up` are the tangents of half
/// the fields of view.
double distanceThatShows(const Eigen::AlignedBox3d& box, const Viewpoint3d& from, double across, double up) {
  const Eigen::Quaterniond to_eye = lookingAt(box.center(), from, 0.0).rotation.inverse();
  double distance_m = 0.0;
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner_m = to_eye * (box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)) - box.center());
    distance_m = std::max(
        {distance_m, std::abs(corner_m.y()) / across - corner_m.x(), std::abs(corner_m.z()) / up - corner_m.x()});
  }
  return kMargin * distance_m;
}

/// The field of view of the camera, with the greater of both if the picture has another shape.
Eye throughCamera(const PlacedCamera& camera, int width_px, int height_px) {
  const double scale = std::min(static_cast<double>(width_px) / camera.lens.width_px,
                                static_cast<double>(height_px) / camera.lens.height_px);
  return {camera.T_map_camera, lensOf(scale * camera.lens.fx_px, width_px, height_px)};
}

}  // namespace

Eigen::AlignedBox3d extentOf(const Picture3d& picture) {
  const std::vector<Vector3d> samples_map_m = samplesOf(picture);
  if (samples_map_m.empty()) return {};
  const auto outer = static_cast<std::size_t>(0.5 * (1.0 - kShare) * static_cast<double>(samples_map_m.size()));
  Eigen::AlignedBox3d box;
  box.setNull();
  std::vector<double> values(samples_map_m.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(samples_map_m.begin(), samples_map_m.end(), values.begin(),
                   [axis](const Vector3d& point_map_m) { return point_map_m[axis]; });
    std::sort(values.begin(), values.end());
    box.min()[axis] = values[outer];
    box.max()[axis] = values[values.size() - 1 - outer];
  }
  return box;
}

Eye eyeOf(const Viewpoint3d& viewpoint, const Picture3d& picture, int width_px, int height_px) {
  using Kind = Viewpoint3d::Kind;
  if (viewpoint.kind == Kind::kCamera && picture.camera) return throughCamera(*picture.camera, width_px, height_px);
  const double tangent = std::tan(0.5 * kFieldOfView_rad);
  const common::PinholeCamera lens = lensOf(0.5 * height_px / tangent, width_px, height_px);
  if (viewpoint.kind == Kind::kWhole) {
    const Eigen::AlignedBox3d box = shownBox(picture);
    const double across = tangent * width_px / height_px;
    return {lookingAt(box.center(), viewpoint, distanceThatShows(box, viewpoint, across, tangent)), lens};
  }
  Vector3d target_map_m = Vector3d::Zero();
  if (viewpoint.kind == Kind::kOrbit)
    target_map_m = {viewpoint.target_x_map_m, viewpoint.target_y_map_m, viewpoint.target_z_map_m};
  else if (picture.vehicle)
    target_map_m = picture.vehicle->T_map_body.position_m;
  return {lookingAt(target_map_m, viewpoint, viewpoint.distance_m), lens};
}

}  // namespace swiftlet::rendering
