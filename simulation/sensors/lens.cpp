#include "simulation/sensors/lens.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/trajectory.hpp"
#include "simulation/sensors/daylight.hpp"

namespace swiftlet::simulation {
namespace {

using common::Duration;
using common::Pose3;
using common::Time;

/// At the ends the pose of the end.
Pose3 poseAt(Time time, std::span<const Moment> track) {
  const auto after =
      std::find_if(track.begin(), track.end(), [time](const Moment& moment) { return moment.time >= time; });
  if (after == track.begin()) return after->T_world_body;
  if (after == track.end()) return track.back().T_world_body;
  const Pose3 &a = (after - 1)->T_world_body, &b = after->T_world_body;
  const double share = (time - (after - 1)->time).seconds() / (after->time - (after - 1)->time).seconds();
  return common::blended(a, b, share);
}

Eigen::Isometry3f isometry(const Pose3& pose) {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear() = pose.rotation.toRotationMatrix().cast<float>();
  T.translation() = pose.position_m.cast<float>();
  return T;
}

/// The point at depth 1 that is seen at a pixel, by fixed-point iteration: distortions of real lenses contract.
Eigen::Vector3d pointAt(const common::PinholeCamera& camera, const RadialDistortion& distortion, int u, int v) {
  constexpr int kIterations = 12;
  const Eigen::Vector3d seen = camera.point_camera_m(u, v, 1.0);
  Eigen::Vector3d point = seen;
  if (distortion.k1 == 0.0 && distortion.k2 == 0.0) return point;
  for (int i = 0; i < kIterations; ++i) {
    const double r2 = point.tail<2>().squaredNorm();
    point.tail<2>() = seen.tail<2>() / (1.0 + distortion.k1 * r2 + distortion.k2 * r2 * r2);
  }
  return point;
}

}  // namespace

Lens::Lens(const common::PinholeCamera& camera, const RadialDistortion& distortion, const Pose3& T_body_camera,
           Duration row_time)
    : camera_(camera),
      T_body_camera_(T_body_camera),
      row_time_(row_time),
      row_(static_cast<std::size_t>(camera.width_px)),
      hits_(row_.size()) {
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) along_.push_back(pointAt(camera, distortion, u, v).cast<float>());
  const std::size_t pixels = along_.size();
  seen_ = {camera.width_px,
           camera.height_px,
           std::vector<float>(pixels),
           std::vector<std::uint8_t>(pixels),
           std::vector<Eigen::Array4f>(pixels, Eigen::Array4f::Zero()),
           {}};
}

const SeenImage& Lens::see(Time time, Duration exposure, std::span<const Moment> track, const RayCaster& rays,
                           const SurfaceShader& shader, const DepthSensor* pattern) {
  const Scene scene{track[track.size() / 2].actors, rays, shader, pattern};
  seen_.motion_px.resize(exposure > Duration() ? along_.size() : 0);
  Exposure at = exposureAt(time, exposure, track);
  for (int v = 0; v < camera_.height_px; ++v) {
    if (v > 0 && row_time_ > Duration()) at = exposureAt(time + row_time_ * v, exposure, track);
    seeRow(v, at, scene);
  }
  return seen_;
}

Lens::Exposure Lens::exposureAt(Time time, Duration exposure, std::span<const Moment> track) const {
  const Duration half = Duration::fromSeconds(0.5 * exposure.seconds());
  const Pose3 T_world_camera = poseAt(time, track) * T_body_camera_;
  const Pose3 T_world_begin = poseAt(time - half, track) * T_body_camera_;
  const Pose3 T_world_end = poseAt(time + half, track) * T_body_camera_;
  return {isometry(T_world_camera), isometry(T_world_begin.inverse() * T_world_camera),
          isometry(T_world_end.inverse() * T_world_camera)};
}

void Lens::seeRow(int v, const Exposure& exposure, const Scene& scene) {
  const Eigen::Matrix3f R_world_camera = exposure.T_world_camera.linear();
  const Eigen::Vector3f origin = exposure.T_world_camera.translation();
  const std::size_t first = static_cast<std::size_t>(v) * row_.size();
  for (std::size_t u = 0; u < row_.size(); ++u) row_[u] = {origin, R_world_camera * along_[first + u].normalized()};
  scene.rays.castAll(row_, kSight_m, scene.actors, hits_);
  const float indoor_light = scene.shader.indoorLight();
  std::vector<std::uint8_t> lit;  // Empty where the light is the same everywhere.
  if (indoor_light < 1.0F) lit = inDaylight(row_, hits_, scene.actors, scene.rays);
  for (std::size_t u = 0; u < row_.size(); ++u) {
    const std::size_t pixel = first + u;
    seePixel(pixel, row_[u], hits_[u], scene);
    if (!lit.empty() && lit[u] == 0) seen_.light[pixel] *= indoor_light;
    if (seen_.motion_px.empty()) continue;
    const float depth_m = std::min(seen_.depth_m[pixel], static_cast<float>(kSight_m));
    seen_.motion_px[pixel] = motion_px(exposure, along_[pixel] * depth_m);
  }
}

void Lens::seePixel(std::size_t pixel, const Ray& ray, const Hit& hit, const Scene& scene) {
  const auto pixel_rad = static_cast<float>(1.0 / camera_.fx_px);
  const SeenSurface surface = scene.shader.see(ray, hit, pixel_rad, scene.actors);
  const auto range_m = static_cast<float>(hit.distance_m);
  seen_.light[pixel].head<3>() = surface.light.array();
  seen_.depth_m[pixel] = range_m / along_[pixel].norm();
  seen_.is_weak[pixel] = scene.pattern != nullptr && scene.pattern->isWeak(range_m, surface) ? 1 : 0;
}

/// From the begin of the exposure to its end, in a world that stands still.
Eigen::Vector2f Lens::motion_px(const Exposure& exposure, const Eigen::Vector3f& point_camera_m) const {
  const Eigen::Vector3f begin = exposure.T_begin_camera * point_camera_m, end = exposure.T_end_camera * point_camera_m;
  if (begin.x() <= 0.0F || end.x() <= 0.0F) return Eigen::Vector2f::Zero();
  return static_cast<float>(camera_.fx_px) * (begin.tail<2>() * (1.0F / begin.x()) - end.tail<2>() * (1.0F / end.x()));
}

}  // namespace swiftlet::simulation
