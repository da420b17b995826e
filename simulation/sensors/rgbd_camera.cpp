#include "simulation/sensors/rgbd_camera.hpp"

#include <algorithm>
#include <memory>

#include "common/check.hpp"
#include "common/random.hpp"

namespace swiftlet::simulation {
namespace {

using common::Duration;
using common::Time;

common::PinholeCamera withFocalShare(common::PinholeCamera camera, double share) {
  camera.fx_px *= share;
  camera.fy_px *= share;
  return camera;
}

Lens lensAt(const common::Pose3& T_body_camera, const common::RgbdCameraConfig& config,
            const RgbdErrorsConfig& errors) {
  return {withFocalShare(config.camera(), errors.focal_share),
          {config.radial_k1, config.radial_k2},
          T_body_camera,
          Duration::fromSeconds(config.row_time_s)};
}

}  // namespace

RgbdCamera::RgbdCamera(const common::RgbdCameraConfig& config, const RgbdErrorsConfig& errors, const WorldModel& world,
                       std::uint64_t seed)
    : config_(config),
      errors_(errors),
      shader_(world),
      lens_(lensAt(errors.T_body_camera(config.mount), config, errors)),
      color_(errors, 1.0 / config.rate_hz, seed),
      depth_(config, errors, seed) {
  if (!config.isStereo()) return;
  // Streams of its own: the same noise in both pictures would be a pattern that both see.
  const std::uint64_t own_seed = common::RandomStream(seed, "right camera", 0).bits();
  right_ = Right{lensAt(errors.T_body_camera(config.mount) * config.T_left_right(), config, errors),
                 ColorSensor(errors, 1.0 / config.rate_hz, own_seed)};
}

Duration RgbdCamera::before() const { return Duration::fromSeconds(0.5 * errors_.longestExposure_s()); }
Duration RgbdCamera::after() const {
  return Duration::fromSeconds(0.5 * errors_.longestExposure_s() + (config_.height_px - 1) * config_.row_time_s);
}

Time RgbdCamera::stampOf(Time time) const {
  return time + Duration::fromSeconds(errors_.clock_offset_s + errors_.clock_drift_ppm * 1e-6 * time.seconds());
}

common::RgbdFrame RgbdCamera::frame(std::uint64_t number, Time time, std::span<const Moment> track,
                                    const RayCaster& rays) {
  SWIFTLET_CHECK(!track.empty() && track.back().time >= time + after());
  common::RgbdFrame frame;
  frame.stamps.measured = stampOf(time);
  frame.row_time = Duration::fromSeconds(config_.row_time_s);
  frame.camera = config_.camera();
  const Duration exposure = Duration::fromSeconds(color_.exposure_s());
  const SeenImage& seen = lens_.see(time, exposure, track, rays, shader_, right_ ? nullptr : &depth_);
  frame.color = color_.take(number, seen);
  if (!right_) {
    frame.depth = depth_.measure(number, seen);
    return frame;
  }
  // The left camera's exposure control leads: both pictures are exposed alike.
  frame.right = std::make_shared<const common::Image>(
      right_->color.takeAs(color_, number, right_->lens.see(time, exposure, track, rays, shader_, nullptr)));
  return frame;
}

}  // namespace swiftlet::simulation
