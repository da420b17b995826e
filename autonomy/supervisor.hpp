// The supervisor above the mission: hold, home and land from the operator, and the reactions to unseen surroundings, a
// lost height, an uncertain position, and a battery that just suffices for the flight home. These work whatever the
// mission does.
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
  double unseen_hold_s = 0.3;
  double unseen_land_s = 1.0;
  double battery_land_share = 0.12;
  double home_reserve_share = 0.02;
  double home_need_factor = 1.15;
  double least_thrust_margin = 1.08;
  double thrust_margin_s = 1.0;
  double height_back_s = 0.5;
  double drift_back_m = 1.0;
  double drift_land_m = 2.0;
  double back_known_s = 1.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

/// The condition of the vehicle at one tick.
struct VehicleCondition {
  common::FlightState flight = common::FlightState::kPreparation;
  common::EnergyLayer energy;
  double vertical_age_s = 0.0;  ///< VehicleState::verticalAge_s.
  double drift_m = 0.0;         ///< Standard deviation of the position, grown since the laser last fixed it fully.
};

/// The request of the supervisor in one tick.
struct Supervision {
  bool hold = false;
  std::string hold_reason;
  /// The flight home, counted from 1; the mission holds meanwhile. 0: none.
  unsigned home = 0;
  /// The flight back along the trail until the vehicle knows its height and position again, counted from 1; the mission
  /// holds meanwhile. 0: none.
  unsigned back = 0;
  bool land = false;  ///< Land for good: the mission is over.
  std::string land_reason;
};

/// One thread.
///
///             hold command, unseen surroundings, the pilot takes over
///   watching --------------------------------------------------------------> holding <-----------+
///     |^  resume command, seen again, the pilot gives control back             | home command   | home is reached,
///     |+------------------------------------------------------------------------+--> going home -+ or not, or hold
///     |+---------------------------------------------------+                             ^       |
///     |  height old, position uncertain        known again |         the charge is what  |       | for the charge
///     +-------------------------------------> flying back -+         the flight home takes       v
///   any -- land command, unseen for unseen_land_s, battery low, no thrust to spare, not known again --> landing
///   (stays)
class Supervisor {
 public:
  explicit Supervisor(const SupervisorConfig& config) : config_(config) {}

  /// Handles and answers hold, resume and land; every other command is for the mission.
  std::optional<common::CommandResult> take(const common::OperatorCommand& command, common::Time now);
  /// Handles and answers home for a mission that does not fly it itself. At home the vehicle holds until resume.
  common::CommandResult goHome(const common::OperatorCommand& command);
  void homeEnded(common::Time now, bool reached, std::string reason);
  /// The flight back has reached the begin of the trail, or failed. The vehicle lands if it still does not know its
  /// height or position.
  void backEnded(common::Time now);
  /// Why every command but land is refused while the vehicle lands; empty if it does not land.
  std::string refusal() const;
  /// A sensor of obstacles saw the surroundings: today a usable scan of the laser.
  void surroundingsSeen(common::Time now) { last_sight_ = now; }
  void pilotArrived(common::Time now, bool takes_over);
  /// False if the sample is not plausible.
  bool batteryArrived(common::Time now, const common::BatterySample& sample);
  bool pilotFlies() const { return pilot_flies_; }

  /// On the ground a fault does not cause a landing.
  const Supervision& tick(common::Time now, const VehicleCondition& condition);

  bool landedByOperator() const { return landed_by_operator_; }
  std::vector<common::Event> takeEvents();

 private:
  void watchSight(common::Time now);
  void watchEnergy(common::Time now, const common::EnergyLayer& energy);
  void watchPosition(common::Time now, const VehicleCondition& condition);
  common::CommandResult resume(std::uint64_t id);
  std::string holdReason() const;
  void land(common::Time now, std::string reason);
  void say(common::Time now, common::Severity severity, std::string text, std::string reason);

  SupervisorConfig config_;
  common::FlightState flight_ = common::FlightState::kPreparation;
  std::optional<common::Time> last_sight_;
  bool operator_holds_ = false;
  bool goes_home_ = false;
  std::string home_reason_;  ///< Why it turned back by itself; empty if the operator wants it home.
  unsigned flights_home_ = 0;
  std::string unknown_;  ///< What the vehicle does not know about its place; empty if it knows it.
  bool flies_back_ = false;
  std::optional<common::Time> known_since_;  ///< Since when height and position have been known well.
  unsigned flights_back_ = 0;
  std::optional<common::Time> weak_since_;  ///< Since when the thrust margin has been too small.
  double charge_said_ = 1.0;                ///< The last charge of which an event told.
  bool landed_by_operator_ = false;
  bool blind_holds_ = false;
  bool pilot_flies_ = false;
  bool battery_plausible_ = true;
  Supervision supervision_;
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
