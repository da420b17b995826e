// The motion of the vehicle as something other than its autonomy knows it: a motion capture system, or the simulator.
#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/trajectory.hpp"

namespace swiftlet::flight {

/// For the records of a flight alone: nothing of it reaches the autonomy. One thread.
class MotionReference {
 public:
  virtual ~MotionReference() = default;

  /// Now.
  virtual common::Pose3 T_map_body() const = 0;
  virtual Eigen::Vector3d velocity_map_m_s() const = 0;
  /// Of the RGB-D camera as it is mounted; asked only if the frames are recorded.
  virtual common::Pose3 T_map_camera() const = 0;
  virtual bool airborne() const = 0;
  /// The poses so far, while airborne.
  virtual const common::Trajectory& path_map() const = 0;
};

}  // namespace swiftlet::flight
