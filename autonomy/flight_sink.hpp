// Those beside a flight: the run folder, the page, the scorer, a recorder. They see everything and change nothing.
#pragma once

#include <memory>

#include "autonomy/input.hpp"
#include "common/command.hpp"
#include "common/event.hpp"
#include "common/intent.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_state.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::autonomy {

/// What a tick came to.
struct TickOutcome {
  common::Time now;
  common::Setpoint setpoint;
  common::VehicleState state;
  common::Intent intent;               ///< Carried out since the last tick of the behaviours,
  common::IntentStatus intent_status;  ///< and how it stands.
};

/// Each function is called in the loop's thread, and need not be overridden. The order is that of the loop: the inputs
/// up to a tick; then, of the tick: its outcome, the world if there is a new snapshot, events, answers to commands.
class FlightSink {
 public:
  virtual ~FlightSink() = default;
  /// Before it is processed. Camera frames, too, are found here.
  virtual void input(const Input& /*input*/) {}
  virtual void ticked(const TickOutcome& /*outcome*/) {}
  /// Never null.
  virtual void world(const std::shared_ptr<const common::World>& /*world*/) {}
  virtual void event(const common::Event& /*event*/) {}
  virtual void result(const common::CommandResult& /*result*/) {}
};

}  // namespace swiftlet::autonomy
