// A linear quadratic regulator on an identified model (Bachrach 2009, section 4): each axis is acceleration = k u + b
// (equation 1), or with damping k1 u + k2 v + b (equation 2). Beyond the paper, the state also has the integral of the
// position error and, where the model has a lag, the acceleration that the vehicle has taken up.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"
#include "control/control_errors.hpp"
#include "control/controller.hpp"
#include "control/riccati.hpp"
#include "control/vehicle_model.hpp"

namespace swiftlet::control {

class Lqr final : public Controller {
 public:
  /// The weights by Bryson's rule: an error of this size costs as much as the acceleration. 0: no weight.
  struct Config {
    double horizontal_integral_m_s = 0.35;
    double horizontal_position_m = 0.24;
    double horizontal_speed_m_s = 0.5;
    double vertical_integral_m_s = 0.3;
    double vertical_position_m = 0.15;
    double vertical_speed_m_s = 0.4;
    double acceleration_m_s2 = 1.0;
    double yaw_rad = 0.25;
    double yaw_rate_rad_s = 0.5;

    void describe(common::config::Fields& fields);
  };

  /// Why there are no gains for these weights and that model: "up: the reason"; empty if there are.
  static std::vector<common::Problem> problemsOf(const Config& config, const VehicleModel& model);

  /// `model` has all axes (VehicleModel::hasAxes), and problemsOf() finds nothing; it is read only here.
  Lqr(const Config& config, const common::VehicleConfig& vehicle, const VehicleModel& model);

  void reset() override;
  common::Setpoint tick(const ControlInput& input, ThrustModel& thrust) override;
  Eigen::Vector3d trim_odom_m_s2(const ThrustModel& thrust) const override;
  void setTrim(const Eigen::Vector3d& trim_odom_m_s2, const ThrustModel& thrust) override;

  /// The gains of the axes x, y and z of odom, on (integral, position, velocity, acceleration).
  const std::array<Eigen::RowVector4d, 3>& gains() const { return gains_; }

 private:
  Eigen::Vector3d wanted(const ControlErrors& errors) const;
  common::Setpoint command(const Eigen::Vector3d& wanted_m_s2, const ControlInput& input, const ControlErrors& errors,
                           const ThrustModel& thrust, Eigen::Vector3d& given_m_s2) const;
  void advance(const ControlErrors& errors, const Eigen::Vector3d& wanted_m_s2, const Eigen::Vector3d& given_m_s2,
               double dt_s);

  common::VehicleConfig vehicle_;
  VehicleModel model_;
  std::array<Eigen::RowVector4d, 3> gains_;
  Eigen::Vector3d lag_s_;
  double yaw_gain_1_s_ = 0.0;
  bool started_ = false;  ///< The vertical integral has been placed at the learned hover command.
  Eigen::Vector3d integral_m_s_ = Eigen::Vector3d::Zero();   ///< Integral of the position error.
  Eigen::Vector3d taken_up_m_s2_ = Eigen::Vector3d::Zero();  ///< Feedback that the lagging vehicle has taken up.
};

}  // namespace swiftlet::control
