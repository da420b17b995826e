// Independent PID controllers of roll, pitch, yaw and thrust, the last with the offset C(U) of the battery's voltage
// (Grzonka 2009, equations 9 and 10; Grzonka 2012, equations 3 to 5).
#pragma once

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"
#include "control/control_errors.hpp"
#include "control/controller.hpp"
#include "control/vehicle_model.hpp"

namespace swiftlet::control {

class VoltagePid final : public Controller {
 public:
  struct Config {
    double horizontal_p_deg_m = 23.0;
    double horizontal_i_deg_m_s = 14.0;
    double horizontal_d_deg_s_m = 18.0;
    double vertical_p_1_m = 0.40;
    double vertical_i_1_m_s = 0.15;
    double vertical_d_s_m = 0.25;
    double yaw_p_1_s = 2.0;

    void describe(common::config::Fields& fields);
  };

  /// `model` gives the mapping from commands to angles; null without one. It is read only here.
  VoltagePid(const Config& config, const common::VehicleConfig& vehicle, const VehicleModel* model);

  void reset() override;
  common::Setpoint tick(const ControlInput& input, ThrustModel& thrust) override;
  Eigen::Vector3d trim_odom_m_s2(const ThrustModel& thrust) const override;
  void setTrim(const Eigen::Vector3d& trim_odom_m_s2, const ThrustModel& thrust) override;

 private:
  void integrate(const ControlErrors& errors, const Eigen::Vector3d& refused, double dt_s);
  /// C(U) takes over the integral part, as it did from one test flight to the next in the paper.
  void learnOffset(ThrustModel& thrust, double dt_s);

  Config config_;
  common::VehicleConfig vehicle_;
  std::vector<CommandAngle> bench_pitch_, bench_roll_;
  /// K_i times the integrated errors: tilts in odom (x: the pitch that accelerates along x), and a share of the thrust.
  Eigen::Vector3d integral_ = Eigen::Vector3d::Zero();
};

}  // namespace swiftlet::control
