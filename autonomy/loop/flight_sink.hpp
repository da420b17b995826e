// Observers of a flight: the run folder, the page, the scorer, a recorder. They see everything and have no effect.
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>

#include "autonomy/input.hpp"
#include "autonomy/requests/run_files.hpp"
#include "common/command.hpp"
#include "common/event.hpp"
#include "common/intent.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_state.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::autonomy {

/// The outcome of a tick.
struct TickOutcome {
  common::Time now;
  common::Setpoint setpoint;
  common::VehicleState state;
  common::Intent intent;               ///< The intent since the last tick of the behaviours.
  common::IntentStatus intent_status;  ///< The status of that intent.
  /// The reference of the controller; nullopt unless the vehicle flies.
  std::optional<Eigen::Vector3d> reference_odom_m = std::nullopt;
};

/// Each function is called in the loop's thread, and may be left out. The order is that of the loop: the inputs up to a
/// tick; then the outcome of the tick, the world if there is a new snapshot, the files that the mission requested, the
/// events, and the answers to commands.
class FlightSink {
 public:
  virtual ~FlightSink() = default;
  /// Called before the input is processed; camera frames are inputs too.
  virtual void input(const Input& /*input*/) {}
  virtual void ticked(const TickOutcome& /*outcome*/) {}
  /// Never null.
  virtual void world(const std::shared_ptr<const common::World>& /*world*/) {}
  virtual void file(const RunFile& /*file*/) {}
  virtual void event(const common::Event& /*event*/) {}
  virtual void result(const common::CommandResult& /*result*/) {}
};

}  // namespace swiftlet::autonomy
