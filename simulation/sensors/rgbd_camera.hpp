// The RGB-D camera: rays through every pixel, and what its two sensors make of the surfaces they hit. Rows are exposed
// one after another while the vehicle moves, if the shutter rolls. A stereo camera has a second lens instead of the
// sensor of depths, and its frames are pairs of pictures.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/sensors/color_sensor.hpp"
#include "simulation/sensors/depth_sensor.hpp"
#include "simulation/sensors/lens.hpp"
#include "simulation/sensors/moment.hpp"
#include "simulation/sensors/sensor_config.hpp"
#include "simulation/sensors/surface_shader.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

class RgbdCamera {
 public:
  RgbdCamera(const common::RgbdCameraConfig& config, const RgbdErrorsConfig& errors, const WorldModel& world,
             std::uint64_t seed);

  /// How long before its time a frame begins to be exposed at the earliest, and how long after it the last row ends at
  /// the latest.
  common::Duration before() const;
  common::Duration after() const;

  /// Frame number `number`; the exposure of its first row has its middle at `time`. `track` is ordered in time; it
  /// covers the longest exposure, or begins with the flight. Only the stamp `measured` is set, by the camera's own
  /// clock. Call it for each frame in its turn.
  common::RgbdFrame frame(std::uint64_t number, common::Time time, std::span<const Moment> track,
                          const RayCaster& rays);

 private:
  /// The right camera of a stereo camera.
  struct Right {
    Lens lens;
    ColorSensor color;
  };
  common::Time stampOf(common::Time time) const;

  common::RgbdCameraConfig config_;
  RgbdErrorsConfig errors_;
  SurfaceShader shader_;
  Lens lens_;
  ColorSensor color_;
  DepthSensor depth_;
  std::optional<Right> right_;
};

}  // namespace swiftlet::simulation
