// Visual odometry alone, flown beside the estimate that the vehicle uses: its trajectory against the truth of the same
// flight (Saeedi, Fig. 1: maps by visual odometry alone fail where those with the poses of the laser do not). As in the
// paper, alone means without other sensors: loops are closed, and the poses are optimized.
#pragma once

#include <cstddef>
#include <optional>

#include "common/trajectory.hpp"

namespace swiftlet::evaluation {

/// The flight by an RGB-D camera alone, without laser, inertial unit and height.
struct VisualOdometryRecord {
  common::Trajectory body;  ///< In a frame of its own; frames that were lost are missing.
  std::size_t frames = 0;   ///< Frames that came.
  std::size_t lost = 0;
};

struct VisualOdometryScore {
  /// Absolute trajectory error after the best rigid motion of the whole trajectory; horizontal and vertical. nullopt if
  /// too little was tracked to align it.
  std::optional<double> rms_m;
  double lost_share = 0.0;  ///< Of the frames that came.
};

/// `truth` as FlightRecord::truth_map. nullopt without a frame.
std::optional<VisualOdometryScore> scoreOf(const VisualOdometryRecord& record, const common::Trajectory& truth);

}  // namespace swiftlet::evaluation
