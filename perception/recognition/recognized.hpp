// What a recognizer says of one object. Pure data.
#pragma once

#include <string>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/passage.hpp"

namespace swiftlet::perception {

using common::Passage;

struct Recognized {
  std::string what;               ///< Name of the object, as it was given to the recognizer.
  common::Pose3 T_sensor_object;  ///< Sensor: `camera` or `laser` of docs/conventions.md.
  /// Of the error (rotation vector, position) in the axes of the sensor: the true pose is
  /// (exp(rotation) * R, t + position). Zero where a planar scan says nothing: height, roll and pitch in its plane.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< rad^2, rad m, m^2.
  double confidence = 0.0;  ///< In (0, 1], from the evidence in this one observation; comparable within a recognizer.
  /// Width and height as far as they were seen; zero of objects without a size, and height zero in a planar scan.
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();
  Passage passage = Passage::kNone;
};

}  // namespace swiftlet::perception
