#include "behaviors/registry.hpp"

#include "behaviors/avoid_obstacle.hpp"
#include "behaviors/emergency_land.hpp"
#include "behaviors/explore.hpp"
#include "behaviors/explore_until_found.hpp"
#include "behaviors/flight_conditions.hpp"
#include "behaviors/follow_me.hpp"
#include "behaviors/follow_path.hpp"
#include "behaviors/go_home.hpp"
#include "behaviors/hold.hpp"
#include "behaviors/inspect.hpp"
#include "behaviors/keep_out.hpp"
#include "behaviors/land.hpp"
#include "behaviors/load_map.hpp"
#include "behaviors/localize.hpp"
#include "behaviors/locate_target.hpp"
#include "behaviors/log_event.hpp"
#include "behaviors/look_around.hpp"
#include "behaviors/move_to_goal.hpp"
#include "behaviors/operator_command.hpp"
#include "behaviors/photograph.hpp"
#include "behaviors/relocalize.hpp"
#include "behaviors/save_map.hpp"
#include "behaviors/set_flight_mode.hpp"
#include "behaviors/survey.hpp"
#include "behaviors/take_off.hpp"
#include "behaviors/turn_to.hpp"
#include "behaviors/wait_for_operator.hpp"

namespace swiftlet::behaviors {
tree::Registry missionRegistry() {
  tree::Registry registry = tree::Registry::standard();
  registry.add<TakeOff>();
  registry.add<Land>();
  registry.add<EmergencyLand>();
  registry.add<Hold>();
  registry.add<Explore>();
  registry.add<ExploreUntilFound>();
  registry.add<LoadMap>();
  registry.add<Localize>();
  registry.add<Relocalize>();
  registry.add<MoveToGoal>();
  registry.add<TurnTo>();
  registry.add<FollowPath>();
  registry.add<Patrol>();
  registry.add<GoHome>();
  registry.add<Survey>();
  registry.add<Inspect>();
  registry.add<LocateTarget>();
  registry.add<LookAround>();
  registry.add<FollowMe>();
  registry.add<ReturnToMe>();
  registry.add<AvoidObstacle>();
  registry.add<OperatorCommand>();
  registry.add<KeepOut>();
  registry.add<SetFlightMode>();
  registry.add<WaitForOperator>();
  registry.add<SaveMap>();
  registry.add<Photograph>();
  registry.add<LogEvent>();
  registry.add<IsBatteryLow>();
  registry.add<IsHomeReachable>();
  registry.add<IsLost>();
  registry.add<IsOperatorHolding>();
  registry.add<IsPersonNear>();
  registry.add<IsExplored>();
  registry.add<IsAt>();
  registry.add<IsTargetFound>();
  return registry;
}

NodeTypes missionNodes() { return std::make_shared<const tree::Registry>(missionRegistry()); }

}  // namespace swiftlet::behaviors
