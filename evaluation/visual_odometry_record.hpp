// Visual odometry alone, flown beside the estimate that the vehicle uses: its trajectory against the truth of the same
// flight (Saeedi, Fig. 1: maps by visual odometry alone fail where those with the poses of the laser do not). As in the
// paper, alone means without other sensors: loops are closed, and the poses are optimized.
#pragma once

#include <cstddef>

#include "common/trajectory.hpp"

namespace swiftlet::evaluation {

/// The flight by an RGB-D camera alone, without laser, inertial unit and height.
struct VisualOdometryRecord {
  common::Trajectory body;  ///< In a frame of its own; frames that were lost are missing.
  std::size_t frames = 0;   ///< Frames that came.
  std::size_t lost = 0;
};

}  // namespace swiftlet::evaluation
