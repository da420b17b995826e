#include "evaluation/knowable_frame.hpp"

#include "simulation/sensors/sensor_config.hpp"

namespace swiftlet::evaluation {

common::Pose3 knowableFrame(const common::Pose3& T_world_start, const simulation::LaserErrorsConfig& errors) {
  const double yaw_rad = common::yawOf(errors.mount_error.pose().rotation);
  return T_world_start * common::lifted({0.0, 0.0, yaw_rad}, 0.0);
}

}  // namespace swiftlet::evaluation
