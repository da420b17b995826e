#include "tests/rendering/example_room.hpp"

#include <cmath>

#include "common/voxel_map.hpp"

namespace swiftlet::testing {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double kSubmap_s = 4.0;
constexpr double kThinned_m = 0.03;
/// A camera that looks a little down, at the front of the vehicle.
const common::Pose3 kT_body_camera{common::quaternionFrom({0.0, 0.15, 0.0}), {0.15, 0.0, 0.0}};

/// A checkered floor, walls by their direction with rows of bricks, and wooden stripes at half height.
std::array<std::uint8_t, 3> colorAt(const Vector3d& p, const Vector3d& normal) {
  const auto odd = [](double a) { return (static_cast<int>(std::floor(a)) & 1) != 0; };
  if (normal.z() > 0.5)
    return odd(2.0 * p.x()) != odd(2.0 * p.y()) ? std::array<std::uint8_t, 3>{196, 178, 150}
                                                : std::array<std::uint8_t, 3>{120, 100, 84};
  const double along = std::abs(normal.x()) > 0.5 ? p.y() : p.x();
  if (odd(10.0 * p.z() + 0.1) && p.z() > 1.1) return {214, 216, 206};
  if (odd(4.0 * along))
    return std::abs(normal.x()) > 0.5 ? std::array<std::uint8_t, 3>{158, 74, 60}
                                      : std::array<std::uint8_t, 3>{70, 104, 148};
  return {206, 196, 182};
}

/// Where the ray enters the box.
std::optional<std::pair<double, Vector3d>> enters(const AlignedBox3d& box, const Vector3d& from,
                                                  const Vector3d& along) {
  double begin = 0.0, end = 1e9;
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    double near = (box.min()[i] - from[i]) / along[i], far = (box.max()[i] - from[i]) / along[i];
    if (near > far) std::swap(near, far);
    if (near > begin) axis = i;
    begin = std::max(begin, near);
    end = std::min(end, far);
  }
  if (axis < 0 || begin >= end) return std::nullopt;
  Vector3d normal = Vector3d::Zero();
  normal[axis] = along[axis] > 0.0 ? -1.0 : 1.0;
  return std::pair(begin, normal);
}

}  // namespace

std::optional<ExampleRoom::Hit> ExampleRoom::hit(const Vector3d& from_map_m, const Vector3d& direction_map) const {
  // No component is zero, so that no division is.
  const Vector3d along = direction_map.unaryExpr([](double v) { return std::abs(v) < 1e-12 ? 1e-12 : v; });
  double distance = 1e9;
  Vector3d normal = Vector3d::UnitZ();
  if (along.z() < 0.0) distance = -from_map_m.z() / along.z();
  for (const AlignedBox3d& box : boxes_)
    if (const auto entry = enters(box, from_map_m, along); entry && entry->first < distance)
      std::tie(distance, normal) = *entry;
  if (distance > 1e8) return std::nullopt;
  const Vector3d point_map_m = from_map_m + distance * along;
  return Hit{distance, point_map_m, normal, colorAt(point_map_m - 1e-6 * normal, normal)};
}

common::RgbdFrame ExampleRoom::frame(const common::Pose3& T_map_camera, common::Time stamp) const {
  common::RgbdFrame frame;
  frame.stamps.measured = frame.stamps.arrived = stamp;
  frame.camera = {160, 120, 140.0, 140.0, 79.5, 59.5};
  frame.color = {160, 120, {}};
  frame.depth = {160, 120, {}};
  for (int v = 0; v < frame.camera.height_px; ++v)
    for (int u = 0; u < frame.camera.width_px; ++u) {
      const auto found = hit(T_map_camera.position_m, T_map_camera.rotation * frame.camera.point_camera_m(u, v, 1.0));
      const auto rgb = found ? found->rgb : std::array<std::uint8_t, 3>{150, 170, 200};
      frame.color.rgb.insert(frame.color.rgb.end(), rgb.begin(), rgb.end());
      frame.depth.depth_m.push_back(!found || found->distance > 5.0 ? common::DepthImage::kTooFar
                                    : found->distance < 0.4         ? common::DepthImage::kUnknown
                                                                    : static_cast<float>(found->distance));
    }
  return frame;
}

std::vector<common::SurfacePoint> ExampleRoom::surface(double spacing_m) const {
  std::vector<common::SurfacePoint> points;
  const auto add = [&](const Vector3d& p, const Vector3d& normal) {
    for (const AlignedBox3d& box : boxes_)
      if (box.contains(Vector3d(p + 1e-6 * normal))) return;
    points.push_back({p.cast<float>(), normal.cast<float>(), colorAt(p - 1e-6 * normal, normal)});
  };
  AlignedBox3d all;
  for (const AlignedBox3d& box : boxes_) {
    all.extend(box);
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true}) {
        const int s = (axis + 1) % 3, t = (axis + 2) % 3;
        const Vector3d normal = (upper ? 1.0 : -1.0) * Vector3d::Unit(axis);
        for (double a = box.min()[s] + 0.5 * spacing_m; a < box.max()[s]; a += spacing_m)
          for (double b = box.min()[t] + 0.5 * spacing_m; b < box.max()[t]; b += spacing_m) {
            Vector3d p;
            p[axis] = upper ? box.max()[axis] : box.min()[axis];
            p[s] = a;
            p[t] = b;
            if (p.z() > 0.0) add(p, normal);
          }
      }
  }
  for (double x = all.min().x(); x < all.max().x(); x += spacing_m)
    for (double y = all.min().y(); y < all.max().y(); y += spacing_m) add({x, y, 0.0}, Vector3d::UnitZ());
  return points;
}

std::shared_ptr<const common::Map3dLayer> ExampleMapper::look(const common::Pose3& T_map_body, common::Time stamp) {
  if (submaps_.empty() || (stamp - keys_.keys.back().stamp).seconds() > kSubmap_s) {
    cubes_.clear();
    growing_.clear();
    keys_.keys.push_back({stamp, common::planar(T_map_body)});
    ++keys_.version;
    common::Submap3d submap;
    submap.key = static_cast<int>(keys_.keys.size()) - 1;
    submap.T_key_submap.position_m.z() = T_map_body.position_m.z();
    submap.voxels = std::make_shared<const common::VoxelMap>(0.05);
    submaps_.push_back(submap);
  }
  layer_.T_map_camera = T_map_body * kT_body_camera;
  const auto frame = std::make_shared<const common::RgbdFrame>(room_.frame(layer_.T_map_camera, stamp));
  const common::Pose3 T_submap_map = submaps_.back().T_map_submap(keys_).inverse();
  for (int v = 0; v < frame->camera.height_px; ++v)
    for (int u = 0; u < frame->camera.width_px; ++u) {
      if (!common::isMeasured(frame->depth.at(u, v))) continue;
      const auto found = room_.hit(layer_.T_map_camera.position_m,
                                   layer_.T_map_camera.rotation * frame->camera.point_camera_m(u, v, 1.0));
      const Vector3d p = T_submap_map * found->point_map_m;
      const Cube cube{std::lround(p.x() / kThinned_m), std::lround(p.y() / kThinned_m),
                      std::lround(p.z() / kThinned_m)};
      if (cubes_.try_emplace(cube, growing_.size()).second)
        growing_.push_back({p.cast<float>(), (T_submap_map.rotation * found->normal_map).cast<float>(), found->rgb});
    }
  submaps_.back().points = std::make_shared<const std::vector<common::SurfacePoint>>(growing_);
  layer_.frame = frame;
  layer_.tracked = true;
  if (!layer_.fused) {
    layer_.fused = std::make_shared<const common::VoxelMap>(0.05);
    layer_.fused_stamp = stamp;
  }
  return publish();
}

std::shared_ptr<const common::Map3dLayer> ExampleMapper::bend(double step_m) {
  ++keys_.version;
  for (std::size_t i = 0; i < keys_.keys.size(); ++i) keys_.keys[i].T_map_key.x_m += step_m * static_cast<double>(i);
  return publish();
}

std::shared_ptr<const common::Map3dLayer> ExampleMapper::publish() {
  layer_.submaps = std::make_shared<const std::vector<common::Submap3d>>(submaps_);
  layer_.keys = std::make_shared<const common::KeyPoses>(keys_);
  return std::make_shared<const common::Map3dLayer>(layer_);
}

}  // namespace swiftlet::testing
