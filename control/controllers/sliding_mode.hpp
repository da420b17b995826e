// Integral sliding mode with time-delay estimation of the disturbance (Tomic 2012, "Action"; Utkin and Shi 1996 for the
// sliding surface, Youcef-Toumi and Ito 1990 for the estimate): the integral leaves no steady error, and the
// accelerometer with the previous commands answers to a gust before it has moved the vehicle.
#pragma once

#include <optional>

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"
#include "control/control_errors.hpp"
#include "control/controller.hpp"
#include "control/smoothed_reference.hpp"

namespace swiftlet::control {

class SlidingMode final : public Controller {
 public:
  struct Config {
    double horizontal_p_1_s2 = 2.2;
    double horizontal_d_1_s = 2.2;
    double vertical_p_1_s2 = 6.0;
    double vertical_d_1_s = 3.8;
    double switching_m_s2 = 1.2;
    double boundary_m_s = 1.2;
    double disturbance_filter_s = 0.5;
    double attitude_lag_s = 0.2;
    double thrust_lag_s = 0.05;
    double yaw_p_1_s = 2.0;

    void describe(common::config::Fields& fields);
  };

  SlidingMode(const Config& config, const common::VehicleConfig& vehicle) : config_(config), vehicle_(vehicle) {}

  void reset() override;
  common::Setpoint tick(const ControlInput& input, ThrustModel& thrust) override;
  Eigen::Vector3d trim_odom_m_s2(const ThrustModel& thrust) const override;
  void setTrim(const Eigen::Vector3d& trim_odom_m_s2, const ThrustModel& thrust) override;

 private:
  ControlErrors smoothedErrors(const ControlInput& input);
  void estimateDisturbance(const ControlInput& input, const Eigen::Vector3d& given_m_s2);
  Eigen::Vector3d slide(const Eigen::Vector3d& nominal_m_s2, const ControlErrors& errors) const;
  void advanceSurface(const Eigen::Vector3d& nominal_m_s2, const Eigen::Vector3d& refused_m_s2,
                      const ControlErrors& errors, double dt_s);

  Config config_;
  common::VehicleConfig vehicle_;
  SmoothedReference smoothed_;
  /// The integral part of the surface, so that sigma = de/dt + integral; nullopt until the surface has been placed
  /// through the present state.
  std::optional<Eigen::Vector3d> integral_m_s_;
  Eigen::Vector3d disturbance_m_s2_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d taken_up_m_s2_ = Eigen::Vector3d::Zero();  ///< The previous commands, as the vehicle follows them.
};

}  // namespace swiftlet::control
