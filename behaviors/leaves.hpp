// The leaves that nothing but missions use: each source adds its own to a registry.
#pragma once

#include "behaviors/tree/registry.hpp"

namespace swiftlet::behaviors {

void addAvoidObstacle(tree::Registry& registry);
void addEmergencyLand(tree::Registry& registry);
void addExplore(tree::Registry& registry);
void addExploreUntilFound(tree::Registry& registry);
void addFindHouse(tree::Registry& registry);
void addFindPositionIndoor(tree::Registry& registry);
void addFindWindow(tree::Registry& registry);
void addFindEntrance(tree::Registry& registry);
void addFlightConditions(tree::Registry& registry);
void addFlyThroughWindow(tree::Registry& registry);
void addFollowMe(tree::Registry& registry);
void addGoHome(tree::Registry& registry);
void addHold(tree::Registry& registry);
void addInspect(tree::Registry& registry);
void addKeepOut(tree::Registry& registry);
void addLand(tree::Registry& registry);
void addLeaveByDoor(tree::Registry& registry);
void addLandOnPattern(tree::Registry& registry);
void addLoadMap(tree::Registry& registry);
void addLocalize(tree::Registry& registry);
void addLocateTarget(tree::Registry& registry);
void addLogEvent(tree::Registry& registry);
void addLookAround(tree::Registry& registry);
void addMoveToGoal(tree::Registry& registry);
void addPhotograph(tree::Registry& registry);
void addPlaceAtObject(tree::Registry& registry);
void addRelocalize(tree::Registry& registry);
void addSaveMap(tree::Registry& registry);
void addSetFlightMode(tree::Registry& registry);
void addTakeOff(tree::Registry& registry);
void addTurnTo(tree::Registry& registry);

}  // namespace swiftlet::behaviors
