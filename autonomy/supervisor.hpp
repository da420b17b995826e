// The supervisor above the mission: hold, home and land from the operator, and what the table of fail-safes says about
// what is found (control/failsafe, autonomy/health). Both work whatever the mission does.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "autonomy/health/checks.hpp"
#include "autonomy/health/health_monitor.hpp"
#include "autonomy/health/supervisor_config.hpp"
#include "common/command.hpp"
#include "common/event_log.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/world/mission_status.hpp"

namespace swiftlet::autonomy {

/// The request of the supervisor in one tick.
struct Supervision {
  bool hold = false;
  std::string hold_reason;
  bool unseen = false;           ///< No sensor sees the surroundings.
  std::string take_off_refusal;  ///< Why the vehicle must not take off; empty if it may, and in the air.
  /// The flight home, counted from 1; the mission holds meanwhile. 0: no such flight.
  unsigned home = 0;
  /// The flight back along the trail until the vehicle knows its height and position again, counted from 1; the mission
  /// holds meanwhile. 0: no such flight.
  unsigned back = 0;
  bool land = false;  ///< Land and stay: the mission is over.
  std::string land_reason;
  common::FlownBy flown_by = common::FlownBy::kMission;
};

/// What the vehicle does by these requests, in words; empty where it is left to the mission.
std::string_view phaseOf(const Supervision& supervision);

/// What the vehicle does once the operator's flight home is over: it holds until Resume, or it waits with the desk for
/// a mission, and a mission that is started then, or meanwhile, is flown.
enum class AtHome { kHold, kWaitForMission };

/// One thread.
///
///             hold command, surroundings unseen, the pilot takes over
///   watching --------------------------------------------------------------> holding <-----------+
///     |^  resume command, seen again, the pilot gives control back              | home command   | home is reached,
///     |+------------------------------------------------------------------------+--> going home -+ or not, or hold
///     |+---------------------------------------------------+                             ^       |
///     |  height or position unknown            known again |             charge for home |       | for the charge
///     +-------------------------------------> flying back -+                             |       v
///   any -- land command, kLand in the table, not known again after flying back ----------------> landing (stays)
class Supervisor {
 public:
  Supervisor(const SupervisorConfig& config, common::EventLog& log) : health_(config), log_(log) {}

  /// Handles and answers hold, resume and land; every other command is for the mission.
  std::optional<common::CommandResult> take(const common::OperatorCommand& command, common::Time now);
  /// Handles and answers home for a mission that does not fly it itself, and for a flight without a mission.
  common::CommandResult goHome(const common::OperatorCommand& command, AtHome then = AtHome::kHold);
  /// The mission has failed in flight: the vehicle flies home and lands there.
  void missionFailed(common::Time now, std::string reason);
  void homeEnded(common::Time now, bool reached, std::string reason);
  /// The flight back has reached the start of the trail, or failed. The vehicle lands if it still does not know its
  /// height or position.
  void backEnded(common::Time now);
  /// Why the command is refused: every one but land while the vehicle lands, and those that lead elsewhere while it
  /// flies home to land. Empty if it is not.
  std::string refusal(const common::OperatorCommand& command) const;
  /// Why the mission holds, or would; empty if it does not.
  std::string holdReason() const;
  /// A sensor of obstacles saw the surroundings: today a usable scan of the laser.
  void surroundingsSeen(common::Time now) { last_sight_ = now; }
  void pilotArrived(common::Time now, bool takes_over);
  bool pilotFlies() const { return pilot_flies_; }

  /// What is unseen or silent in the condition is filled in here.
  const Supervision& tick(common::Time now, VehicleCondition condition);
  /// Of the last tick.
  const Supervision& supervision() const { return supervision_; }

  bool landedByOperator() const { return landed_by_operator_; }
  /// It flies home, or will when a hold ends, and lands there.
  bool sentHome() const { return home_.forced(); }

 private:
  /// A flight home, requested by the operator or, with a reason, for the charge or because the mission has failed. The
  /// latter two end in a landing.
  struct FlightHome {
    bool active = false;
    std::string reason;
    unsigned count = 0;
    AtHome then = AtHome::kHold;

    bool forced() const { return active && !reason.empty(); }
  };
  void begin(common::Time now, const Finding& finding);
  void end(common::Time now, control::FindingKind what);
  void followPlace(common::Time now);
  const Finding* unknownPlace() const;
  control::Response activeResponse() const;
  std::string takeOffRefusal() const;
  void startHome(std::string reason, AtHome then = AtHome::kHold);
  common::CommandResult resume(std::uint64_t id);
  common::FlownBy flownBy() const;
  /// `concern`: kNone if the operator requested it.
  void land(common::Time now, std::string reason, common::Concern concern = common::Concern::kLanding);

  HealthMonitor health_;
  common::EventLog& log_;
  std::optional<common::Time> last_sight_;
  common::FlightState flight_ = common::FlightState::kPreparation;
  bool operator_holds_ = false;
  bool pilot_flies_ = false;
  common::Time pilot_heard_;  ///< When the last of the pilot's samples arrived.
  FlightHome home_;
  unsigned flights_back_ = 0;
  bool flies_back_ = false;  ///< Along the trail, because height or position is unknown.
  bool landed_by_operator_ = false;
  Supervision supervision_;
};

}  // namespace swiftlet::autonomy
