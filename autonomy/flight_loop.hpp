// The loop that flies: lets a vehicle's time pass, gives the autonomy what comes of it, and the vehicle its setpoints.
// It knows neither a simulator nor a clock: the caller decides how fast time passes, and may step several loops side by
// side.
//
//   step(now):  the vehicle's events up to now, each behind the jobs due at its arrival
//               the operator's commands
//               the jobs due now
//               the tick  ==> setpoint --> vehicle
#pragma once

#include <vector>

#include "autonomy/input_feed.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::common {
class Vehicle;
struct OperatorCommand;
template <typename Value>
class LosslessQueue;
}  // namespace swiftlet::common

namespace swiftlet::autonomy {

/// One thread; any thread may push commands. Refers to what it is given, which must outlive it.
class FlightLoop {
 public:
  FlightLoop(common::Vehicle& vehicle, Autonomy& autonomy, common::LosslessQueue<common::OperatorCommand>& commands,
             std::vector<FlightSink*> sinks);

  /// To be called every common::kControlPeriod of the vehicle's time. Returns false when nothing more comes of the
  /// vehicle (crashed, end of the log, link closed), which the sinks have then been told as an event.
  [[nodiscard]] bool step(common::Time now);

  /// Once, after the last step: tells the sinks which kinds of jobs took longer than they were declared to take.
  void finish();

  common::Time now() const { return now_; }

 private:
  void deliverDue(common::Time now);

  common::Vehicle& vehicle_;
  Autonomy& autonomy_;
  common::LosslessQueue<common::OperatorCommand>& commands_;
  InputFeed feed_;
  std::vector<common::SensorEvent> events_;
  common::Time now_;
};

}  // namespace swiftlet::autonomy
