// A stereo camera over a floor whose depths are known.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config.hpp"
#include "common/rgbd_camera_config.hpp"
#include "simulation/appearance/patterns.hpp"
#include "simulation/sensors/rgbd_camera.hpp"
#include "tests/simulation/fixtures.hpp"

namespace swiftlet {

/// The one that is shipped, at a size.
inline common::RgbdCameraConfig shippedPair(int width_px = 376) {
  auto sheet =
      common::config::readFile<common::RgbdCameraConfig>(SWIFTLET_SOURCE_DIR "/config/sensors/firefly_stereo.yaml");
  sheet.width_px = width_px;
  sheet.height_px = width_px == 376 ? 240 : 480;
  return sheet;
}

/// A room of 10 x 8 m with boxes of 0.3 to 0.8 m in it; everything is covered with the pattern.
inline simulation::WorldModel furnishedRoom(simulation::Pattern pattern) {
  simulation::WorldModel world = simulation::boxRoom();
  const std::vector<Eigen::Vector3d> places_m = {{1.5, 0.6, 0.5}, {-1.0, -1.2, 0.3}, {2.5, -1.5, 0.8}, {0.4, 2.2, 0.6}};
  for (const Eigen::Vector3d& at_m : places_m)
    world.shapes.push_back(simulation::boxShape("box" + std::to_string(world.shapes.size()),
                                                {at_m.x() - 0.3, at_m.y() - 0.3, 0.0},
                                                {at_m.x() + 0.3, at_m.y() + 0.3, at_m.z()}));
  for (simulation::Shape& shape : world.shapes) shape.pattern = pattern;
  return world;
}

/// Errors of the nature `dlr`.
inline simulation::RgbdErrorsConfig ordinaryErrors() {
  simulation::RgbdErrorsConfig errors;
  errors.pixel_noise = 1.5;
  errors.exposure_s = 0.004;
  errors.longest_exposure_s = 0.03;
  errors.exposure_lag_s = 0.8;
  return errors;
}

/// Pairs of a camera in a world, and the true depths of what it sees.
class PairRig {
 public:
  PairRig(const common::RgbdCameraConfig& sheet, simulation::WorldModel world,
          const simulation::RgbdErrorsConfig& errors = ordinaryErrors())
      : sheet_(sheet), world_(std::move(world)), rays_(world_), camera_(sheet, errors, world_, 1), truth_([&] {
          common::RgbdCameraConfig exact = sheet;
          exact.depth = common::DepthMethod::kPattern;
          exact.baseline_m = exact.inverse_depth_noise_1_m = exact.inverse_depth_step_1_m = exact.depth_step_m = 0.0;
          exact.radial_k1 = exact.radial_k2 = 0.0;
          exact.range_min_m = 0.01;
          exact.range_max_m = 60.0;
          return exact;
        }()) {}

  /// Taken at that pose of the body, which stands still or moves with these speeds along and about its own axes.
  common::RgbdFrame taken(const common::Pose3& T_world_body, double time_s = 1.0,
                          const Eigen::Vector3d& speed_m_s = {0, 0, 0}, double yaw_rate_rad_s = 0.0) {
    std::vector<simulation::Moment> track;
    for (int ms = -20; ms <= 20; ++ms) {
      const double dt_s = 1e-3 * ms;
      const common::Pose3 moved{common::quaternionFrom({0.0, 0.0, yaw_rate_rad_s * dt_s}), speed_m_s * dt_s};
      track.push_back({common::Time::fromSeconds(time_s + dt_s), T_world_body * moved, {}});
    }
    return camera_.frame(number_++, common::Time::fromSeconds(time_s), track, rays_);
  }
  common::DepthImage trueDepth(const common::Pose3& T_world_body) const {
    simulation::RgbdErrorsConfig none;
    none.pixel_noise = 0.0;
    simulation::RgbdCamera camera(truth_, none, world_, 1);
    const simulation::Moment still{common::Time::fromSeconds(1.0), T_world_body, {}};
    return camera.frame(0, still.time, std::vector<simulation::Moment>{still, still}, rays_).depth;
  }
  common::Pose3 T_body_camera() const { return sheet_.mount.pose(); }

 private:
  common::RgbdCameraConfig sheet_;
  simulation::WorldModel world_;
  simulation::RayCaster rays_;
  simulation::RgbdCamera camera_;
  common::RgbdCameraConfig truth_;
  std::uint64_t number_ = 0;
};

/// Over the middle of the room at that height.
inline common::Pose3 hovering(double height_m, double x_m = 0.0, double y_m = 0.0, double yaw_rad = 0.0) {
  return {common::quaternionFrom({0.0, 0.0, yaw_rad}), {x_m, y_m, height_m}};
}

}  // namespace swiftlet
