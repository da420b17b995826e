// What an inertial unit would measure, predicted from the setpoints while it gives nothing that can be used: the
// attitude follows roll, pitch and yaw rate of the setpoint with a lag, and the specific force along the rotors' axis
// is gravity times the share of the hover thrust. With it the filter goes on by laser and height (Tomic 2012, "Action",
// requires a fall-back when inertial measurements fail), and the descent is steered by the position.
#pragma once

#include <optional>

#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/vehicle.hpp"

namespace swiftlet::autonomy {

/// One thread.
class ImuSubstitute {
 public:
  /// Lag of the thrust behind its command: motors of 25 to 60 ms (docs/decisions/control.md#028).
  static constexpr double kThrustLag_s = 0.05;

  /// The lag of the attitude behind a setpoint that the controllers assume.
  explicit ImuSubstitute(double attitude_lag_s) : attitude_lag_s_(attitude_lag_s) {}

  /// A sample that was used. What is predicted goes on from the last one.
  void measured(const common::ImuSample& sample);
  /// The setpoint that is flown from now on, and its thrust over that which carries the weight.
  void flown(const common::Setpoint& setpoint, double thrust_over_hover);
  /// The next sample, one control period after the last one; nullopt if that is later than `now`, before the first
  /// measured sample, and when that is longer ago than any descent takes.
  std::optional<common::ImuSample> next(common::Time now);

 private:
  double attitude_lag_s_;
  std::optional<common::ImuSample> last_;
  common::Time measured_;   ///< Stamp of the last measured sample.
  common::Duration delay_;  ///< From measurement to arrival, of the last measured sample.
  common::Setpoint setpoint_;
  double thrust_over_hover_ = 1.0;   ///< Of the setpoint.
  double force_over_gravity_ = 1.0;  ///< The thrust, behind its lag.
};

}  // namespace swiftlet::autonomy
