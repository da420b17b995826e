// Gives an autonomy its inputs and passes the outcome to the sinks. A flight and its replay share it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "autonomy/input.hpp"
#include "common/event.hpp"
#include "common/vehicle.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::autonomy {

class Autonomy;
class FlightSink;

/// One thread. Refers to the autonomy and the sinks, which must outlive it. The sinks are called in the given order.
class InputFeed {
 public:
  InputFeed(Autonomy& autonomy, std::vector<FlightSink*> sinks);

  /// Passes the input to the sinks and to the autonomy, and the outcome to the sinks. Returns the result of
  /// Autonomy::process.
  std::optional<common::Setpoint> give(const Input& input);
  /// Passes an event of the autonomy or of its vehicle to the sinks, with the vehicle's name added.
  void tell(common::Event event);

 private:
  void publish(common::Time now, const common::Setpoint& setpoint);

  Autonomy& autonomy_;
  std::vector<FlightSink*> sinks_;
  std::shared_ptr<const common::World> last_world_;
};

}  // namespace swiftlet::autonomy
