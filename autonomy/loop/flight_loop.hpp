// The loop that flies: it advances a vehicle, gives its events to the autonomy, and gives the setpoints to the vehicle.
// It depends on neither a simulator nor a clock: the caller decides how fast time passes, and may step several loops in
// turn.
//
//   step(now):  the vehicle's events up to now, each after the jobs due at its arrival
//               the operator's commands
//               the jobs due now
//               the tick  ==> setpoint --> vehicle
#pragma once

#include <utility>
#include <vector>

#include "autonomy/loop/input_feed.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::common {
class Vehicle;
struct OperatorCommand;
template <typename Value>
class LosslessQueue;
}  // namespace swiftlet::common

namespace swiftlet::autonomy {

/// One thread; any thread may push commands. Refers to its arguments, which must outlive it.
class FlightLoop {
 public:
  FlightLoop(common::Vehicle& vehicle, Autonomy& autonomy, common::LosslessQueue<common::OperatorCommand>& commands,
             std::vector<FlightSink*> sinks);

  /// Call it every common::kControlPeriod of the vehicle's time. Returns false if the vehicle sends nothing more
  /// (crashed, end of the log, link closed); the sinks have then received this as an event.
  [[nodiscard]] bool step(common::Time now);

  /// Call it once, after the last step. It reports to the sinks which kinds of jobs took longer than declared.
  void finish();

  /// An event of the program around the loop, for every sink.
  void tell(common::Event event) { feed_.tell(std::move(event)); }

  /// The time of the last step; before the first that of the vehicle.
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
