// Cascaded PID: position -> velocity -> acceleration -> roll, pitch and thrust; P on yaw (Grzonka 2012, equations 3 to
// 5; Saeedi, III-E). The reference's velocity and acceleration are fed forward.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"
#include "control/controller.hpp"
#include "control/lagged_reference.hpp"
#include "control/thrust_model.hpp"

namespace swiftlet::control {

/// The default controller. It keeps the integral between ticks.
class PositionController final : public Controller {
 public:
  struct Config {
    double horizontal_p_1_s = 1.4;
    double horizontal_v_1_s = 3.0;
    double horizontal_i_1_s2 = 2.0;
    double vertical_p_1_s = 1.8;
    double vertical_v_1_s = 4.5;
    double vertical_i_1_s2 = 2.0;
    double yaw_p_1_s = 2.0;
    double max_speed_m_s = 1.5;
    double max_yaw_rate_deg_s = 90.0;
    double attitude_lag_s = 0.2;
    ThrustModel::Config thrust;

    void describe(common::config::Fields& fields);
  };

  PositionController(const Config& config, const common::VehicleConfig& vehicle);

  /// Keeps the learned hover command.
  void reset() override;
  common::Setpoint tick(const ControlInput& input, ThrustModel& thrust) override;
  Eigen::Vector3d trim_odom_m_s2(const ThrustModel&) const override { return integral_m_s2_; }
  void setTrim(const Eigen::Vector3d& trim_odom_m_s2, const ThrustModel& thrust) override;

 private:
  /// The velocity error, including the correction for the position error, on which the velocity and integral gains act.
  Eigen::Vector3d missingVelocity(const common::VehicleState& state, const Reference& reference, Horizontal horizontal,
                                  double share) const;

  void turnTrim(double yaw_rad);

  Config config_;
  common::VehicleConfig vehicle_;
  Eigen::Vector3d integral_m_s2_ = Eigen::Vector3d::Zero();
  std::optional<double> trim_yaw_rad_;  ///< Yaw at the last tick; nullopt before the first.
  LaggedReference lagged_;
};

}  // namespace swiftlet::control
