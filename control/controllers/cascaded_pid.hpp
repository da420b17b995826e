// Nested loops of PID controllers (Saeedi, III-E, after Nagaty 2013): the outer one from the position to roll and
// pitch, the altitude by one of its own; the attitude is the autopilot's.
#pragma once

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"
#include "control/control_errors.hpp"
#include "control/controller.hpp"

namespace swiftlet::control {

class CascadedPid final : public Controller {
 public:
  struct Config {
    double horizontal_p_1_s2 = 4.0;
    double horizontal_i_1_s3 = 2.5;
    double horizontal_d_1_s = 3.2;
    double vertical_p_1_s2 = 7.0;
    double vertical_i_1_s3 = 3.0;
    double vertical_d_1_s = 4.5;
    double yaw_p_1_s = 2.0;

    void describe(common::config::Fields& fields);
  };

  CascadedPid(const Config& config, const common::VehicleConfig& vehicle) : config_(config), vehicle_(vehicle) {}

  void reset() override { integral_m_s2_.setZero(); }
  common::Setpoint tick(const ControlInput& input, ThrustModel& thrust) override;
  Eigen::Vector3d trim_odom_m_s2(const ThrustModel&) const override { return integral_m_s2_; }
  void setTrim(const Eigen::Vector3d& trim_odom_m_s2, const ThrustModel&) override { integral_m_s2_ = trim_odom_m_s2; }

 private:
  Config config_;
  common::VehicleConfig vehicle_;
  Eigen::Vector3d integral_m_s2_ = Eigen::Vector3d::Zero();
};

}  // namespace swiftlet::control
