// The onboard camera of the operator's stream: each surface in its colour, shaded by a lamp at the camera and by
// distance.
#pragma once

#include <cstdint>
#include <span>

#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/sensors/sensor_config.hpp"
#include "simulation/sensors/surface_shader.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

class Camera {
 public:
  Camera(const CameraConfig& config, const WorldModel& world, std::uint64_t seed);

  /// Frame number `frame`; the same pose and number give the same picture, whatever was rendered before.
  common::Image render(std::uint64_t frame, const common::Pose3& T_world_body, std::span<const Actor> actors,
                       const RayCaster& rays) const;

 private:
  CameraConfig config_;
  std::uint64_t seed_;
  common::Pose3 T_body_camera_;
  SurfaceShader shader_;
};

}  // namespace swiftlet::simulation
