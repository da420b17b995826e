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

/// One thread. Refers to the autonomy and the sinks, which must outlive it; the sinks are called in their order here.
class InputFeed {
 public:
  InputFeed(Autonomy& autonomy, std::vector<FlightSink*> sinks);

  /// The answer of Autonomy::process.
  std::optional<common::Setpoint> give(const Input& input);
  /// An event, the autonomy's own or another of its vehicle; the sinks are told it with the vehicle's name.
  void tell(common::Event event);

 private:
  void publish(common::Time now, const common::Setpoint& setpoint);

  Autonomy& autonomy_;
  std::vector<FlightSink*> sinks_;
  std::shared_ptr<const common::World> last_world_;
};

}  // namespace swiftlet::autonomy
