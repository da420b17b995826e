// The inertial samples that the filter gets: those that were measured, those of which a part is replaced because it
// contradicts the rest, or, while none can be used, those that the setpoints predict.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "autonomy/inertial/imu_substitute.hpp"
#include "autonomy/inertial/imu_watch.hpp"
#include "autonomy/inertial/inertial_check.hpp"
#include "common/event_log.hpp"
#include "common/hysteresis.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/vehicle.hpp"

namespace swiftlet::autonomy {

/// One thread.
class InertialInput {
 public:
  /// The lag of the attitude that the controllers assume.
  InertialInput(double attitude_lag_s, common::EventLog& log) : log_(log), substitute_(attitude_lag_s) {}

  /// The filter's input for a sample that arrived; nullopt if it is of no use.
  std::optional<common::ImuSample> take(const common::ImuSample& sample);
  /// The next sample that replaces measured ones; nullopt while those can be used, on the ground, and while a pilot
  /// overrides the setpoints. To be called at each tick until it returns nullopt.
  std::optional<common::ImuSample> predicted(common::Time now);
  /// Call at each tick of the control.
  void flown(const common::Setpoint& setpoint, const InertialContext& context);

  /// Why measured samples cannot be used at `now`; empty if they can. As of ImuWatch::fault.
  std::string_view fault(common::Time now) const { return watch_.fault(now); }
  /// Samples arrive, but a part of them is replaced.
  bool contradicted() const { return contradicted_.active(); }
  /// Why the vehicle must come down although samples arrive; empty if it need not.
  std::string mustLandFor(common::Time now) const;

 private:
  common::EventLog& log_;
  ImuWatch watch_;
  InertialCheck check_;
  common::Hysteresis contradicted_;
  ImuSubstitute substitute_;
  bool airborne_ = false;
  bool setpoints_apply_ = true;
};

}  // namespace swiftlet::autonomy
