// The one interface between the autonomy and what flies: the simulator, or the driver of a real vehicle.
#pragma once

#include <string>
#include <vector>

#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

/// The time between two ticks of the autonomy, and between two setpoints.
inline constexpr Duration kControlPeriod = Duration::fromMilliseconds(10);

/// The command of the autonomy to the autopilot's inner loop, once each kControlPeriod.
struct Setpoint {
  Time stamp;
  bool motors_on = false;
  double roll_rad = 0.0;        ///< FLU: positive rolls to the right (left side up).
  double pitch_rad = 0.0;       ///< FLU: positive pitches nose down, the vehicle accelerates forwards.
  double yaw_rate_rad_s = 0.0;  ///< Positive counter-clockwise seen from above.
  double thrust = 0.0;          ///< Collective, from 0 to 1: share of the greatest thrust at full battery.
};

/// A vehicle whose time is advanced step by step. Called from one thread.
class Vehicle {
 public:
  virtual ~Vehicle() = default;

  virtual Time now() const = 0;

  /// Advances to `time` and appends the events that arrived since the last call, ordered by arrival; events that arrive
  /// at the same instant come in a fixed order. A simulator computes; a real vehicle waits until `time`.
  /// Returns false when no more events will come (crashed, end of the log, link closed); `stopReason` then gives the
  /// reason.
  [[nodiscard]] virtual bool advanceTo(Time time, std::vector<SensorEvent>& events) = 0;

  /// Sends a setpoint to the autopilot. It stays in force until the next one; the autopilot's rule for a lost link
  /// applies.
  virtual void apply(const Setpoint& setpoint) = 0;

  /// Why advanceTo returned false; empty while it returns true.
  virtual std::string stopReason() const = 0;
};

}  // namespace swiftlet::common
