// Taking off and landing: the height reference that moves by itself, and the signs by which a take-off or a landing
// ends.
#pragma once

#include <optional>
#include <string>

#include "common/hysteresis.hpp"
#include "common/time.hpp"
#include "common/vehicle_state.hpp"
#include "control/flight_state_machine.hpp"
#include "control/margin_limits.hpp"
#include "control/thrust_model.hpp"
#include "control/tick_clock.hpp"

namespace swiftlet::control {

/// ```
///   start:   spool up --spoolUpShare() is nullopt--> climb --takeOffEnd()--> hover reached, or land
///   restart:                                         descend --touchedDown()--> on the ground
/// ```
/// Heights are those of the body over the take-off floor. One thread; states are finite.
class VerticalFlight {
 public:
  /// What a take-off ends with, and why.
  struct End {
    FlightInput input;
    std::string reason;
  };

  VerticalFlight(double climb_m_s, double descent_m_s, double max_height_m)
      : climb_m_s_(climb_m_s), descent_m_s_(descent_m_s), max_height_m_(max_height_m) {}

  /// Greatest height of the vehicle.
  void setMaxHeight(double height_m) { max_height_m_ = height_m; }
  double maxHeight_m() const { return max_height_m_; }
  /// Why a vehicle that stands at `standing_m` cannot take off to that height; empty if it can.
  std::string refusal(double height_m, double standing_m) const;
  /// Height at which a take-off ends.
  void setGoal(double height_m) { goal_m_ = height_m; }
  double goal_m() const { return goal_m_; }

  /// A take-off starts. `standing_raw_m` is the height that the mirror measures while the vehicle stands.
  void start(common::Time now, double standing_m, double standing_raw_m);
  /// The reference continues from there, and the times of hovering, of touching the ground and of full thrust begin
  /// anew.
  void restart(double height_m, double climb_m_s);
  /// A take-off that continues in the air has its motors spooled up.
  void skipSpoolUp(common::Time now);

  /// The share of the hover command that spools up the motors; nullopt once they run.
  std::optional<double> spoolUpShare(common::Time now) const;
  /// Moves the reference towards the goal by one tick.
  void climb(const TickClock& clock, const common::VehicleState& state, const MarginLimits& margin);
  /// `command` is the thrust of the setpoint.
  std::optional<End> takeOffEnd(const TickClock& clock, const common::VehicleState& state, double command,
                                const ThrustModel& thrust);
  /// Moves the reference down by one tick. A vehicle that `drifts`, without a position, sinks faster.
  void descend(const TickClock& clock, const common::VehicleState& state, const MarginLimits& margin, bool drifts);
  /// Why the vehicle counts as landed; nullopt while it does not. `command` is the thrust of the setpoint.
  std::optional<std::string> touchedDown(const TickClock& clock, const common::VehicleState& state, double command,
                                         const ThrustModel& thrust);

  /// The reference.
  double height_m() const { return height_m_; }
  double rate_m_s() const { return rate_m_s_; }
  /// The present take-off, or the last one, has left the ground.
  bool lifted() const { return lifted_; }
  double standingRaw_m() const { return standing_raw_m_; }
  /// The ground may carry a part of the weight.
  bool nearGround(const common::VehicleState& state) const;
  /// Duration of a landing from that height onto the take-off floor.
  double landing_s(double height_m, const MarginLimits& margin) const;

 private:
  void move(double goal_m, double speed_m_s, double height_m, const TickClock& clock, const MarginLimits& margin);

  double climb_m_s_, descent_m_s_;
  double max_height_m_;
  double goal_m_ = 1.0;
  double standing_m_ = 0.0;
  double standing_raw_m_ = 0.0;
  double height_m_ = 0.0;
  double rate_m_s_ = 0.0;
  bool lifted_ = false;
  common::Time started_;
  common::Hysteresis spent_, hovers_;  ///< A take-off has all of the thrust, or hovers at its height.
  common::Hysteresis rests_;           ///< A landing has touched the ground.
};

}  // namespace swiftlet::control
