#include "simulation/sensors/rgbd_camera.hpp"

#include <algorithm>
#include <cmath>

#include "common/check.hpp"
#include "common/trajectory.hpp"

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

common::PinholeCamera withFocalShare(common::PinholeCamera camera, double share) {
  camera.fx_px *= share;
  camera.fy_px *= share;
  return camera;
}

}  // namespace

RgbdCamera::RgbdCamera(const common::RgbdCameraConfig& config, const RgbdErrorsConfig& errors, const WorldModel& world,
                       std::uint64_t seed)
    : config_(config),
      errors_(errors),
      true_camera_(withFocalShare(config.camera(), errors.focal_share)),
      T_body_camera_(errors.T_body_camera(config.mount)),
      shader_(world),
      color_(errors, 1.0 / config.rate_hz, seed),
      depth_(config, errors, seed),
      row_(static_cast<std::size_t>(config.width_px)),
      hits_(row_.size()) {
  for (int v = 0; v < config.height_px; ++v)
    for (int u = 0; u < config.width_px; ++u) along_.push_back(true_camera_.point_camera_m(u, v, 1.0).cast<float>());
  const std::size_t pixels = along_.size();
  seen_ = {config.width_px,
           config.height_px,
           std::vector<float>(pixels),
           std::vector<std::uint8_t>(pixels),
           std::vector<Eigen::Array4f>(pixels, Eigen::Array4f::Zero()),
           std::vector<Eigen::Vector2f>(errors.exposure_s > 0.0 ? pixels : 0)};
}

Duration RgbdCamera::before() const { return Duration::fromSeconds(0.5 * errors_.exposure_s); }
Duration RgbdCamera::after() const {
  return Duration::fromSeconds(0.5 * errors_.exposure_s + (config_.height_px - 1) * config_.row_time_s);
}

Time RgbdCamera::stampOf(Time time) const {
  return time + Duration::fromSeconds(errors_.clock_offset_s + errors_.clock_drift_ppm * 1e-6 * time.seconds());
}

common::RgbdFrame RgbdCamera::frame(std::uint64_t number, Time time, std::span<const Moment> track,
                                    const RayCaster& rays) {
  SWIFTLET_CHECK(!track.empty() && track.back().time >= time + after());
  const Duration row_time = Duration::fromSeconds(config_.row_time_s);
  const std::vector<Actor>& actors = track[track.size() / 2].actors;
  Exposure exposure = exposureAt(time, track);
  for (int v = 0; v < config_.height_px; ++v) {
    if (v > 0 && config_.row_time_s > 0.0) exposure = exposureAt(time + row_time * v, track);
    seeRow(v, exposure, actors, rays);
  }
  common::RgbdFrame frame;
  frame.stamps.measured = stampOf(time);
  frame.row_time = row_time;
  frame.camera = config_.camera();
  frame.color = color_.take(number, seen_);
  frame.depth = depth_.measure(number, seen_);
  return frame;
}

RgbdCamera::Exposure RgbdCamera::exposureAt(Time time, std::span<const Moment> track) const {
  const Pose3 T_world_camera = poseAt(time, track) * T_body_camera_;
  const Pose3 T_world_begin = poseAt(time - before(), track) * T_body_camera_;
  const Pose3 T_world_end = poseAt(time + before(), track) * T_body_camera_;
  return {isometry(T_world_camera), isometry(T_world_begin.inverse() * T_world_camera),
          isometry(T_world_end.inverse() * T_world_camera)};
}

void RgbdCamera::seeRow(int v, const Exposure& exposure, std::span<const Actor> actors, const RayCaster& rays) {
  const Eigen::Matrix3f R_world_camera = exposure.T_world_camera.linear();
  const Eigen::Vector3f origin = exposure.T_world_camera.translation();
  const std::size_t first = static_cast<std::size_t>(v) * row_.size();
  for (std::size_t u = 0; u < row_.size(); ++u) row_[u] = {origin, R_world_camera * along_[first + u].normalized()};
  rays.castAll(row_, kSight_m, actors, hits_);
  for (std::size_t u = 0; u < row_.size(); ++u) {
    const std::size_t pixel = first + u;
    seePixel(pixel, row_[u], hits_[u], along_[pixel], actors);
    if (seen_.motion_px.empty()) continue;
    const float depth_m = std::min(seen_.depth_m[pixel], static_cast<float>(kSight_m));
    seen_.motion_px[pixel] = motion_px(exposure, along_[pixel] * depth_m);
  }
}

void RgbdCamera::seePixel(std::size_t pixel, const Ray& ray, const Hit& hit, const Eigen::Vector3f& along,
                          std::span<const Actor> actors) {
  const auto pixel_rad = static_cast<float>(1.0 / true_camera_.fx_px);
  const SeenSurface surface = shader_.see(ray, hit, pixel_rad, actors);
  const auto range_m = static_cast<float>(hit.distance_m);
  seen_.light[pixel].head<3>() = surface.light.array();
  seen_.depth_m[pixel] = range_m / along.norm();
  seen_.is_weak[pixel] = depth_.isWeak(range_m, surface) ? 1 : 0;
}

/// From the begin of the exposure to its end, in a world that stands still.
Eigen::Vector2f RgbdCamera::motion_px(const Exposure& exposure, const Eigen::Vector3f& point_camera_m) const {
  const Eigen::Vector3f begin = exposure.T_begin_camera * point_camera_m, end = exposure.T_end_camera * point_camera_m;
  if (begin.x() <= 0.0F || end.x() <= 0.0F) return Eigen::Vector2f::Zero();
  return static_cast<float>(true_camera_.fx_px) *
         (begin.tail<2>() * (1.0F / begin.x()) - end.tail<2>() * (1.0F / end.x()));
}

}  // namespace swiftlet::simulation
