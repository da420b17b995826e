#include "autonomy/snapshot.hpp"

namespace swiftlet::autonomy {

WorldParts partsOf(const Percept& percept, const Commander& commander, const Navigator& navigator,
                   const common::World* last) {
  const Executor& executor = navigator.executor();
  const Surroundings& around = *percept.around;
  const perception::PeopleTracker& people = percept.estimator->people();
  WorldParts parts;
  parts.vehicle.state = percept.state;
  parts.vehicle.flight_state = navigator.controller().state();
  parts.vehicle.avoidance = navigator.avoidance().status;
  parts.vehicle.plan_map_m = executor.remainingPlan_map_m();
  parts.vehicle.laser = navigator.laserPoints();
  parts.vehicle.drift_m = percept.drift_m;
  parts.mission = commander.missionLayer(last);
  parts.mission.intent = executor.status();
  const Aim aim = executor.aim();
  if (aim.goal_map_m) parts.mission.goal_map_m = aim.goal_map_m;
  parts.map = {around.grid,         around.levels,      executor.desk().frontiers(), executor.desk().exploredArea_m2(),
               around.localization, around.T_map_given, commander.keepOut().zones(), around.flown,
               around.given};
  parts.people.people = people.expectedAt(percept.now);
  parts.people.followed_map_m = aim.person_map_m;
  parts.map3d = around.map3d;
  parts.targets.targets = around.targets;
  parts.objects = around.objects;
  parts.energy = commander.energy(percept, navigator, last);
  return parts;
}

}  // namespace swiftlet::autonomy
