// The RGB-D camera: colour by the light of surfaces, and depth along the view with the noise and the steps of
// disparities.
#pragma once

#include <cstdint>
#include <span>

#include "common/geometry.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/sensors/sensor_config.hpp"
#include "simulation/sensors/surface_shader.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

class RgbdCamera {
 public:
  RgbdCamera(const common::RgbdCameraConfig& config, const RgbdErrorsConfig& errors, const WorldModel& world,
             std::uint64_t seed);

  /// Frame number `number`, exposed at `time`. Only the stamp `measured` is set, by the camera's own clock. The same
  /// arguments give the same frame, whatever was rendered before.
  common::RgbdFrame frame(std::uint64_t number, common::Time time, const common::Pose3& T_world_body,
                          std::span<const Actor> actors, const RayCaster& rays) const;

 private:
  common::Time stampOf(common::Time time) const;
  void measureDepths(std::uint64_t number, common::DepthImage& depth) const;

  common::RgbdCameraConfig config_;
  RgbdErrorsConfig errors_;
  std::uint64_t seed_;
  common::Pose3 T_body_camera_;
  SurfaceShader shader_;
};

}  // namespace swiftlet::simulation
