// The sensor events of a vehicle. Every event has two stamps: when it was measured and when it arrived at the computer.
// Events are immutable values; large ones are held by shared_ptr<const ...>.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/image.hpp"
#include "common/stamps.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

struct RgbdFrame;  // common/rgbd_frame.hpp

/// One inertial sample with the attitude of the vehicle's own AHRS.
struct ImuSample {
  Stamps stamps;
  Eigen::Vector3d angular_velocity_body_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_body_m_s2 = Eigen::Vector3d::Zero();  ///< +g upwards at rest.
  /// Roll and pitch are good to about 1 deg; yaw drifts and has an arbitrary origin.
  Eigen::Quaterniond rotation_ahrs_body = Eigen::Quaterniond::Identity();
};

/// One sweep of the 2D laser, in the laser frame. It includes the beams that a mirror deflects (see LaserConfig).
struct LaserScan {
  Stamps stamps;
  double angle_min_rad = 0.0;
  double angle_increment_rad = 0.0;
  Duration time_increment;  ///< Between two beams; beam i was measured at stamps.measured + i * time_increment.
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  /// A range that is NaN or below range_min_m is invalid. A range above range_max_m, or infinite, means no hit.
  std::vector<float> ranges_m;
};

/// One sweep of a second laser, whose scan plane stands upright; it has no mirror. It is a type of its own, so that it
/// cannot be matched as a scan of the first laser.
struct VerticalScan : LaserScan {};

/// What the vehicle's power module and its fuel gauge measure.
struct BatterySample {
  Stamps stamps;
  double voltage_v = 0.0;  ///< At the terminals, under load.
  double remaining = 1.0;  ///< In [0, 1]: the fuel gauge's estimate, which may be some percent off.
  double current_a = 0.0;  ///< Drawn from the battery.
};

/// The pilot's sticks, each in [-1, 1]; thrust in [0, 1]. While the switch `takes_over` is on, the pilot flies alone.
struct PilotSample {
  Stamps stamps;
  double roll = 0.0;
  double pitch = 0.0;
  double yaw_rate = 0.0;
  double thrust = 0.0;
  bool takes_over = false;
};

/// One frame of the onboard camera, for the operator's stream.
struct CameraFrame {
  Stamps stamps;
  Image image;
};

using SensorEvent = std::variant<ImuSample, std::shared_ptr<const LaserScan>, BatterySample, PilotSample,
                                 std::shared_ptr<const CameraFrame>, std::shared_ptr<const RgbdFrame>,
                                 std::shared_ptr<const VerticalScan>>;

const Stamps& stampsOf(const SensorEvent& event);

}  // namespace swiftlet::common
