// The supervisor above the mission: hold and land from the operator, and the reactions to a silent laser and an empty
// battery. These work whatever the mission does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/command.hpp"
#include "common/config_fwd.hpp"
#include "common/event.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/flight_state.hpp"

namespace swiftlet::autonomy {

struct SupervisorConfig {
  double laser_hold_s = 0.3;
  double laser_land_s = 1.0;
  double battery_land_share = 0.12;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

/// The request of the supervisor in one tick.
struct Supervision {
  bool hold = false;
  std::string hold_reason;
  /// The flight home that the operator asked for, counted from 1; the mission holds meanwhile. 0: none.
  unsigned home = 0;
  bool land = false;  ///< Land for good: the mission is over.
  std::string land_reason;
};

/// One thread.
///
///             hold command, no scan for laser_hold_s, the pilot takes over
///   watching --------------------------------------------------------------> holding <-----------+
///      ^  resume command, scans are back, the pilot gives control back          | home command   | home is reached,
///      +------------------------------------------------------------------------+--> going home -+ or not, or hold
///   any -- land command, no scan for laser_land_s, battery low --> landing (stays)
class Supervisor {
 public:
  explicit Supervisor(const SupervisorConfig& config) : config_(config) {}

  /// Handles and answers hold, resume and land; every other command is for the mission.
  std::optional<common::CommandResult> take(const common::OperatorCommand& command, common::Time now);
  /// Handles and answers home for a mission that does not fly it itself. At home the vehicle holds until resume.
  common::CommandResult goHome(const common::OperatorCommand& command);
  void homeEnded(common::Time now, bool reached, std::string reason);
  /// Why every command but land is refused while the vehicle lands; empty if it does not land.
  std::string refusal() const;
  void scanArrived(common::Time now) { last_scan_ = now; }
  void pilotArrived(common::Time now, bool takes_over);
  /// False if the sample is not plausible.
  bool batteryArrived(common::Time now, const common::BatterySample& sample);
  bool pilotFlies() const { return pilot_flies_; }

  /// On the ground a fault does not cause a landing.
  const Supervision& tick(common::Time now, common::FlightState flight, const common::EnergyLayer& energy);

  bool landedByOperator() const { return landed_by_operator_; }
  std::vector<common::Event> takeEvents();

 private:
  common::CommandResult resume(std::uint64_t id);
  std::string holdReason() const;
  void land(common::Time now, std::string reason);
  void say(common::Time now, common::Severity severity, std::string text, std::string reason);

  SupervisorConfig config_;
  common::FlightState flight_ = common::FlightState::kPreparation;
  std::optional<common::Time> last_scan_;
  bool operator_holds_ = false;
  bool goes_home_ = false;
  unsigned flights_home_ = 0;
  bool landed_by_operator_ = false;
  bool laser_holds_ = false;
  bool pilot_flies_ = false;
  bool battery_plausible_ = true;
  Supervision supervision_;
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
