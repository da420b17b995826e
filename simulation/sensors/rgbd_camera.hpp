// The RGB-D camera: rays through every pixel, and what its two sensors make of the surfaces they hit. Rows are exposed
// one after another while the vehicle moves, if the shutter rolls.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/sensors/color_sensor.hpp"
#include "simulation/sensors/depth_sensor.hpp"
#include "simulation/sensors/moment.hpp"
#include "simulation/sensors/seen_image.hpp"
#include "simulation/sensors/sensor_config.hpp"
#include "simulation/sensors/surface_shader.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

class RgbdCamera {
 public:
  RgbdCamera(const common::RgbdCameraConfig& config, const RgbdErrorsConfig& errors, const WorldModel& world,
             std::uint64_t seed);

  /// How long before its time a frame begins to be exposed, and how long after it the last row ends.
  common::Duration before() const;
  common::Duration after() const;

  /// Frame number `number`; the exposure of its first row has its middle at `time`. `track` is ordered in time; it
  /// covers the exposure, or begins with the flight. Only the stamp `measured` is set, by the camera's own clock. Call
  /// it for each frame in its turn.
  common::RgbdFrame frame(std::uint64_t number, common::Time time, std::span<const Moment> track,
                          const RayCaster& rays);

 private:
  /// The camera while a row is exposed: at the middle, and how points move in its view from there to begin and end.
  struct Exposure {
    Eigen::Isometry3f T_world_camera;
    Eigen::Isometry3f T_begin_camera;
    Eigen::Isometry3f T_end_camera;
  };
  common::Time stampOf(common::Time time) const;
  Exposure exposureAt(common::Time time, std::span<const Moment> track) const;
  void seeRow(int v, const Exposure& exposure, std::span<const Actor> actors, const RayCaster& rays);
  void seePixel(std::size_t pixel, const Ray& ray, const Hit& hit, const Eigen::Vector3f& along,
                std::span<const Actor> actors);
  Eigen::Vector2f motion_px(const Exposure& exposure, const Eigen::Vector3f& point_camera_m) const;

  common::RgbdCameraConfig config_;
  RgbdErrorsConfig errors_;
  common::PinholeCamera true_camera_;
  common::Pose3 T_body_camera_;
  SurfaceShader shader_;
  ColorSensor color_;
  DepthSensor depth_;
  std::vector<Eigen::Vector3f> along_;  ///< By pixel: the point at depth 1 on its ray.
  SeenImage seen_;                      ///< Kept between frames to save the allocation, as are the next two.
  std::vector<Ray> row_;
  std::vector<Hit> hits_;
};

}  // namespace swiftlet::simulation
