// Decides what is flown: the supervisor before the mission, and both by what the operator orders.
//
//   Percept --> Supervisor --hold, home, back, land--+
//                                                    v
//   command --> one judge --> mission's tree -----> Intent
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/decision.hpp"
#include "autonomy/map_shelf.hpp"
#include "autonomy/mission_desk.hpp"
#include "autonomy/percept.hpp"
#include "autonomy/requests/flight_requests.hpp"
#include "autonomy/supervisor.hpp"
#include "autonomy/supervisor_intents.hpp"
#include "behaviors/context.hpp"
#include "common/command.hpp"
#include "common/event_log.hpp"
#include "common/intent.hpp"
#include "common/time.hpp"
#include "common/world.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/mission_layer.hpp"

namespace swiftlet::autonomy {

struct AutonomyConfig;
struct AutonomySetup;
class Navigator;

/// One thread.
class Commander {
 public:
  /// Takes the mission of the setup.
  Commander(const AutonomyConfig& config, AutonomySetup& setup, common::EventLog& log);

  /// See Autonomy::waitForStart.
  void waitForStart() { missions_.waitForStart(); }
  /// See Autonomy::offerMaps.
  void offerMaps(std::vector<OfferedMap> maps) { map_shelf_.offer(std::move(maps)); }

  /// The navigator switches its controller where the operator requests another.
  void take(const common::OperatorCommand& command, common::Time now, const common::World& world, Navigator& navigator);
  void pilotArrived(const common::PilotSample& sample);

  /// What the charge and the thrust are good for; `last` is the newest snapshot, null before the first.
  common::EnergyLayer energy(const Percept& percept, const Navigator& navigator, const common::World* last) const;
  /// `world` is the snapshot of this tick, or the newest one between the ticks of the behaviours.
  const Decision& decide(const Percept& percept, const std::shared_ptr<const common::World>& world,
                         const Navigator& navigator);

  /// The last one.
  const Decision& decision() const { return decision_; }
  const KeepOutZones& keepOut() const { return requests_.keepOut(); }
  bool missionOver() const { return common::isOver(status_.state); }
  const common::MissionStatus& missionStatus() const { return status_; }
  /// The layer of the snapshot, without the navigator's part.
  common::MissionLayer missionLayer(const common::World* last) const;
  /// True if the mission ended by the operator's land command.
  bool landedByOperator() const { return supervisor_.landedByOperator(); }

  std::vector<common::CommandResult> takeResults() { return std::exchange(results_, {}); }
  /// The files that the mission requested since the last call.
  std::vector<RunFile> takeFiles() { return requests_.takeFiles(); }

 private:
  std::string resolvePlaces(common::OperatorCommand& command, const common::World& world) const;
  std::optional<common::CommandResult> takeMission(const common::OperatorCommand& command, bool airborne);
  void answer(const common::OperatorCommand& command, common::CommandResult result, common::Time now,
              const common::PlaceNames& names);
  void hear(const Percept& percept, const Navigator& navigator);
  common::Intent nextIntent(const Percept& percept, const Navigator& navigator);
  common::Intent chooseIntent(const Supervision& supervision, const Navigator& navigator);
  VehicleCondition condition(const Percept& percept, const Navigator& navigator) const;
  void fillContext(const Supervision& supervision, const Navigator& navigator);
  bool waitsToTakeOff(const Supervision& supervision) const;
  void tellWhoFlies(const Supervision& supervision, const common::Intent& intent, const Navigator& navigator);
  void endMission(const std::string& reason);
  void tickMission(const Navigator& navigator);
  void carryOut(const common::MissionRequest& request);
  void followMission();

  SupervisorConfig config_;
  common::EventLog& log_;
  double vehicle_max_height_m_;
  Supervisor supervisor_;
  SupervisorIntents supervisor_intents_;
  FlightRequests requests_;
  MapShelf map_shelf_;
  MissionDesk missions_;
  bool map_given_;
  behaviors::Context context_;
  common::MissionStatus status_;
  bool releasing_mission_ = false;  ///< The supervisor lands the vehicle, and the mission has not released it yet.
  Decision decision_;
  std::vector<common::CommandResult> results_;
};

}  // namespace swiftlet::autonomy
