// An RGB-D camera at a known pose, for tests of its models.
#pragma once

#include <vector>

#include "common/rgbd_camera_config.hpp"
#include "fixtures.hpp"
#include "simulation/sensors/rgbd_camera.hpp"

namespace swiftlet::simulation {

/// Its measurements are exact.
inline common::RgbdCameraConfig exactCamera() {
  common::RgbdCameraConfig config;
  config.width_px = 160;
  config.height_px = 120;
  config.range_min_m = 0.3;
  config.range_max_m = 20.0;
  config.baseline_m = 0.0;
  config.inverse_depth_noise_1_m = config.inverse_depth_step_1_m = config.depth_step_m = 0.0;
  config.mount = {};
  return config;
}

inline RgbdErrorsConfig withoutNoise() {
  RgbdErrorsConfig errors;
  errors.pixel_noise = 0.0;
  return errors;
}

/// From 0.2 s before to 0.2 s after time 1 s; at that time the pose is `pose`, turning to the left.
inline std::vector<Moment> turning(const common::Pose3& pose, double yaw_rate_rad_s = 0.0) {
  std::vector<Moment> track;
  for (int ms = 800; ms <= 1200; ++ms) {
    const double turned_rad = yaw_rate_rad_s * 1e-3 * (ms - 1000);
    const common::Pose3 T_pose_turned{common::quaternionFrom({0.0, 0.0, turned_rad}), Eigen::Vector3d::Zero()};
    track.push_back({common::Time() + common::Duration::fromMilliseconds(ms), pose * T_pose_turned, {}});
  }
  return track;
}

inline const common::Time kFrameTime = common::Time::fromSeconds(1.0);

/// Frame 0 of a camera in the world, taken at `pose`.
inline common::RgbdFrame frameOf(const WorldModel& world, const common::RgbdCameraConfig& config,
                                 const RgbdErrorsConfig& errors, const common::Pose3& pose = {},
                                 double yaw_rate_rad_s = 0.0) {
  RgbdCamera camera(config, errors, world, 1);
  return camera.frame(0, kFrameTime, turning(pose, yaw_rate_rad_s), RayCaster(world));
}

/// A wall across the view of a camera at the origin, `distance_m` ahead.
inline WorldModel wallAhead(double distance_m, const Color& color = Color::Constant(0.5F)) {
  WorldModel world;
  world.shapes = {boxShape("wall", {distance_m, -20.0, -20.0}, {distance_m + 0.1, 20.0, 20.0})};
  world.shapes[0].color = color;
  world.shapes[0].pattern = Pattern::kBlank;
  return world;
}

inline int count(const common::DepthImage& image, float value) {
  return static_cast<int>(std::count(image.depth_m.begin(), image.depth_m.end(), value));
}

}  // namespace swiftlet::simulation
