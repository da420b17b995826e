// A walk in the rendered room with turns of up to 40 deg/s.
#pragma once

#include <cmath>

#include "common/geometry.hpp"

namespace swiftlet::mapping3d {

constexpr double kWalkFrames_Hz = 15.0;

inline common::Pose3 walk(double time_s) {
  const double yaw_rad = 0.9 * std::sin(0.75 * time_s), pitch_rad = 0.15 * std::sin(1.3 * time_s);
  return {common::quaternionFrom({0.1 * std::sin(0.9 * time_s), pitch_rad, yaw_rad}),
          {0.4 * std::sin(0.6 * time_s), 0.5 * std::sin(0.5 * time_s), 0.2 * std::sin(0.8 * time_s)}};
}

}  // namespace swiftlet::mapping3d
