// The supervisor above the mission: hold, home and land from the operator, and the requests of its watches: of the
// sight, of the energy, and of what is known of height and position. These work whatever the mission does.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "autonomy/watches/energy_watch.hpp"
#include "autonomy/watches/position_watch.hpp"
#include "autonomy/watches/sight_watch.hpp"
#include "autonomy/watches/supervisor_config.hpp"
#include "autonomy/watches/watch_request.hpp"
#include "common/command.hpp"
#include "common/event.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/world/mission_status.hpp"

namespace swiftlet::autonomy {

/// The request of the supervisor in one tick.
struct Supervision {
  bool hold = false;
  std::string hold_reason;
  bool unseen = false;  ///< No sensor sees the surroundings.
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
///             hold command, SightWatch, the pilot takes over
///   watching --------------------------------------------------------------> holding <-----------+
///     |^  resume command, seen again, the pilot gives control back              | home command   | home is reached,
///     |+------------------------------------------------------------------------+--> going home -+ or not, or hold
///     |+---------------------------------------------------+                             ^       |
///     |  PositionWatch                         known again |                 EnergyWatch |       | for the charge
///     +-------------------------------------> flying back -+                             |       v
///   any -- land command, any watch, not known again after flying back -------------------------> landing (stays)
class Supervisor {
 public:
  explicit Supervisor(const SupervisorConfig& config)
      : pilot_silent_s_(config.pilot_silent_s), sight_(config), energy_(config), position_(config) {}

  /// Handles and answers hold, resume and land; every other command is for the mission.
  std::optional<common::CommandResult> take(const common::OperatorCommand& command, common::Time now);
  /// Handles and answers home for a mission that does not fly it itself, and for a flight without a mission.
  common::CommandResult goHome(const common::OperatorCommand& command, AtHome then = AtHome::kHold);
  void homeEnded(common::Time now, bool reached, std::string reason);
  /// The flight back has reached the start of the trail, or failed. The vehicle lands if it still does not know its
  /// height or position.
  void backEnded(common::Time now);
  /// Why the command is refused: every one but land while the vehicle lands, and those that lead elsewhere while it
  /// flies home to land. Empty if it is not.
  std::string refusal(const common::OperatorCommand& command) const;
  /// Why the mission holds, or would; empty if it does not.
  std::string holdReason() const;
  /// Why the vehicle must not take off, with the figure; empty if it may.
  std::string takeOffRefusal(const common::EnergyLayer& energy) const { return energy_.takeOffRefusal(energy); }
  /// A sensor of obstacles saw the surroundings: today a usable scan of the laser.
  void surroundingsSeen(common::Time now) { sight_.surroundingsSeen(now); }
  void pilotArrived(common::Time now, bool takes_over);
  bool pilotFlies() const { return pilot_flies_; }
  /// No sensor of obstacles sees the surroundings, as of the last tick.
  bool seesNothing() const { return supervision_.unseen; }

  /// On the ground a fault does not cause a landing.
  const Supervision& tick(common::Time now, const VehicleCondition& condition);

  bool landedByOperator() const { return landed_by_operator_; }
  std::vector<common::Event> takeEvents();

 private:
  /// A flight home, requested by the operator or, with a reason, by the EnergyWatch. The latter ends in a landing.
  struct FlightHome {
    bool active = false;
    std::string reason;
    unsigned count = 0;
    AtHome then = AtHome::kHold;

    bool forced() const { return active && !reason.empty(); }
  };
  /// Does the immediate part of a request, and returns it for the rest.
  WatchRequest obey(common::Time now, WatchRequest request);
  void startHome(std::string reason, AtHome then = AtHome::kHold);
  common::CommandResult resume(std::uint64_t id);
  void watchPilot(common::Time now);
  common::FlownBy flownBy() const;
  /// `concern`: kNone if the operator requested it.
  void land(common::Time now, std::string reason, common::Concern concern = common::Concern::kLanding);
  void say(common::Time now, common::Severity severity, std::string text, std::string reason,
           common::Concern concern = common::Concern::kNone);

  double pilot_silent_s_;
  SightWatch sight_;
  EnergyWatch energy_;
  PositionWatch position_;
  common::FlightState flight_ = common::FlightState::kPreparation;
  bool operator_holds_ = false;
  bool pilot_flies_ = false;
  common::Time pilot_heard_;  ///< When the last of the pilot's samples arrived.
  FlightHome home_;
  unsigned back_ = 0;  ///< The flight back that the PositionWatch requests.
  std::string blind_;  ///< Why the SightWatch holds; empty if it does not.
  bool landed_by_operator_ = false;
  Supervision supervision_;
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
