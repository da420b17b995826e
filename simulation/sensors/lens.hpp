// A moving lens: the rays through its pixels, row by row, and the surfaces that they meet.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "common/time.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/sensors/depth_sensor.hpp"
#include "simulation/sensors/moment.hpp"
#include "simulation/sensors/seen_image.hpp"
#include "simulation/sensors/surface_shader.hpp"

namespace swiftlet::simulation {

/// By how much a point is seen farther from the axis than without distortion, by powers of the tangent of its angle to
/// the axis: 1 + k1 r^2 + k2 r^4 (Brown 1966).
struct RadialDistortion {
  double k1 = 0.0;
  double k2 = 0.0;
};

class Lens {
 public:
  Lens(const common::PinholeCamera& camera, const RadialDistortion& distortion, const common::Pose3& T_body_camera,
       common::Duration row_time);

  /// The exposure of the first row has its middle at `time`; each lasts for `exposure`, 0 where nothing blurs.
  /// `pattern` tells which surfaces return too little of a projected pattern; null without one. The result lasts until
  /// the next call.
  const SeenImage& see(common::Time time, common::Duration exposure, std::span<const Moment> track,
                       const RayCaster& rays, const SurfaceShader& shader, const DepthSensor* pattern);

 private:
  /// The camera while a row is exposed: at the middle, and how points move in its view from there to begin and end.
  struct Exposure {
    Eigen::Isometry3f T_world_camera;
    Eigen::Isometry3f T_begin_camera;
    Eigen::Isometry3f T_end_camera;
  };
  /// What the rays of a frame may meet.
  struct Scene {
    std::span<const Actor> actors;
    const RayCaster& rays;
    const SurfaceShader& shader;
    const DepthSensor* pattern;
  };
  Exposure exposureAt(common::Time time, common::Duration exposure, std::span<const Moment> track) const;
  void seeRow(int v, const Exposure& exposure, const Scene& scene);
  void seePixel(std::size_t pixel, const Ray& ray, const Hit& hit, const Scene& scene);
  Eigen::Vector2f motion_px(const Exposure& exposure, const Eigen::Vector3f& point_camera_m) const;

  common::PinholeCamera camera_;
  common::Pose3 T_body_camera_;
  common::Duration row_time_;
  std::vector<Eigen::Vector3f> along_;  ///< By pixel: the point at depth 1 on its ray.
  SeenImage seen_;                      ///< Kept between frames to save the allocation, as are the next two.
  std::vector<Ray> row_;
  std::vector<Hit> hits_;
};

}  // namespace swiftlet::simulation
