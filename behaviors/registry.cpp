#include "behaviors/registry.hpp"

#include "behaviors/follow_path.hpp"
#include "behaviors/leaves.hpp"
#include "behaviors/operator_command.hpp"
#include "behaviors/survey.hpp"
#include "behaviors/wait_for_operator.hpp"

namespace swiftlet::behaviors {

tree::Registry missionRegistry() {
  tree::Registry registry = tree::Registry::standard();
  addAvoidObstacle(registry);
  addEmergencyLand(registry);
  addExplore(registry);
  addExploreUntilFound(registry);
  addFindHouse(registry);
  addFindPositionIndoor(registry);
  addFindWindow(registry);
  addFindEntrance(registry);
  addFlightConditions(registry);
  addFlyThroughWindow(registry);
  addFollowMe(registry);
  addGoHome(registry);
  addHold(registry);
  addInspect(registry);
  addKeepOut(registry);
  addLand(registry);
  addLeaveByDoor(registry);
  addLandOnPattern(registry);
  addLoadMap(registry);
  addLocalize(registry);
  addLocateTarget(registry);
  addLogEvent(registry);
  addLookAround(registry);
  addMoveToGoal(registry);
  addPhotograph(registry);
  addPlaceAtObject(registry);
  addRelocalize(registry);
  addSaveMap(registry);
  addSetFlightMode(registry);
  addTakeOff(registry);
  addTurnTo(registry);
  registry.add<FollowPath>();
  registry.add<OperatorCommand>();
  registry.add<Patrol>();
  registry.add<Survey>();
  registry.add<WaitForOperator>();
  return registry;
}

NodeTypes missionNodes() {
  static const NodeTypes kTypes = std::make_shared<const tree::Registry>(missionRegistry());
  return kTypes;
}

}  // namespace swiftlet::behaviors
