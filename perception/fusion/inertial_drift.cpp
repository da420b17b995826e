#include "perception/fusion/inertial_drift.hpp"

#include <optional>

#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "common/gravity.hpp"

namespace swiftlet::perception {
namespace {

using Eigen::Vector3d;

/// Dead reckoning of the velocity in the frame of the AHRS.
class Integration {
 public:
  void add(const common::ImuSample& sample) {
    const bool finite = sample.specific_force_body_m_s2.allFinite() && sample.rotation_ahrs_body.coeffs().allFinite();
    if (!finite) return;
    const Vector3d acceleration_m_s2 =
        sample.rotation_ahrs_body * sample.specific_force_body_m_s2 - common::kGravity_m_s2 * Vector3d::UnitZ();
    if (last_) velocity_m_s_ += (sample.stamps.measured - *last_).seconds() * acceleration_m_s2;
    last_ = sample.stamps.measured;
    yaw_rad_ = common::yawOf(sample.rotation_ahrs_body);
  }
  /// The velocity is this one from now on.
  void setForward(const Vector3d& level_m_s) {
    velocity_m_s_ = Eigen::AngleAxisd(yaw_rad_, Vector3d::UnitZ()) * level_m_s;
  }
  double forward_m_s() const { return inLevelBody(yaw_rad_, velocity_m_s_).x(); }

 private:
  std::optional<common::Time> last_;
  Vector3d velocity_m_s_ = Vector3d::Zero();
  double yaw_rad_ = 0.0;
};

}  // namespace

std::vector<ForwardVelocity> inertialDrift(const TapedFlight& flight, const FusionConfig& config) {
  TapedReplay replay(flight, config);
  Integration integration;
  const auto integrate = [&](const FilterInput& input) {
    if (const auto* imu = std::get_if<common::ImuSample>(&input)) integration.add(*imu);
  };
  std::vector<ForwardVelocity> velocities;
  std::optional<common::Time> first;
  while (const TrueMotion* truth = replay.next(integrate)) {
    if (!replay.filter().initialized()) continue;
    const Vector3d true_m_s = inLevelBody(truth->yaw_map_rad, truth->velocity_map_m_s);
    if (!first) {
      first = truth->stamp;
      integration.setForward(true_m_s);
    }
    const common::VehicleState state = replay.filter().state();
    velocities.push_back({(truth->stamp - *first).seconds(), true_m_s.x(),
                          inLevelBody(common::yawOf(state.T_odom_body.rotation), state.velocity_odom_m_s).x(),
                          integration.forward_m_s()});
  }
  return velocities;
}

}  // namespace swiftlet::perception
