// Finds coloured targets in a single RGB-D frame.
//
//   frame --> pixels of a class's colour --> connected pieces --> size in metres --> does it stand out? --> sightings
//
// Colour is compared by hue and saturation, which the brightness of the light does not change. A picture of a target
// lies in the surface around it; a target has something behind its outline.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/rgbd_frame.hpp"
#include "perception/targets/color_classes.hpp"
#include "perception/targets/target_config.hpp"

namespace swiftlet::perception {

/// A target as one frame shows it.
struct TargetSighting {
  std::uint8_t color = 0;  ///< Index of its class.
  /// Middle of the target, behind the surface that is seen.
  Eigen::Vector3d point_camera_m = Eigen::Vector3d::Zero();
  /// Of the error of the middle that differs from frame to frame, in the axes of the camera.
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  double diameter_m = 0.0;  ///< Of a disc with the same area.
};

/// Immutable; safe from any thread. The same frame gives the same bits.
class TargetDetector {
 public:
  explicit TargetDetector(std::vector<TargetClassConfig> classes);

  /// A frame whose images have another size than its camera has no sightings.
  std::vector<TargetSighting> detect(const common::RgbdFrame& frame) const;

  const std::vector<TargetClassConfig>& classes() const { return classes_; }

 private:
  bool hasSize(std::uint8_t color, double diameter_m) const;

  std::vector<TargetClassConfig> classes_;
  ColorClasses colors_;
};

}  // namespace swiftlet::perception
