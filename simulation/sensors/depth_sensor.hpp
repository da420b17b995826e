// Depth by the disparity of a projected pattern, from true depths.
#pragma once

#include <cstdint>
#include <vector>

#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "simulation/sensors/seen_image.hpp"
#include "simulation/sensors/sensor_config.hpp"
#include "simulation/sensors/surface_shader.hpp"

namespace swiftlet::simulation {

/// A disparity is proportional to the inverse depth, so bias, noise and steps are added to it; the noise and the steps
/// of a depth then grow with its square (Khoshelham and Elberink 2012). Nothing is measured where the pattern returns
/// too little, at some pixels beside an edge, and where the projector's view is blocked: to the left of near surfaces,
/// since the projector is to the right of the camera.
class DepthSensor {
 public:
  DepthSensor(const common::RgbdCameraConfig& config, const RgbdErrorsConfig& errors, std::uint64_t seed);

  /// Whether a surface at that distance returns too little of the pattern: it is dark, far, or seen at a glancing
  /// angle.
  bool isWeak(float range_m, const SeenSurface& surface) const {
    return range_m * range_m > seen_m2_ * surface.reflectance * surface.cos_incidence ||
           surface.cos_incidence < least_cos_;
  }

  common::DepthImage measure(std::uint64_t number, const SeenImage& seen) const;

 private:
  void dropShadows(const SeenImage& seen, std::vector<float>& depth_m) const;
  void dropEdges(std::uint64_t number, const SeenImage& seen, std::vector<float>& depth_m) const;
  void addNoise(std::uint64_t number, std::vector<float>& depth_m) const;

  common::RgbdCameraConfig config_;
  RgbdErrorsConfig errors_;
  std::uint64_t seed_;
  float seen_m2_;    ///< Squared distance at which a white surface across the view is still seen.
  float least_cos_;  ///< Of the incidence.
};

}  // namespace swiftlet::simulation
