#include "behaviors/looking_leaf.hpp"

#include "common/world.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

/// Until a frame from there is looked at: latencies of link and job, and the least time between two frames.
constexpr double kLookingTime_s = 0.8;
constexpr double kLookTolerance_m = 0.2;  ///< The picture is the same from there; nearer would take longer.

common::GoToIntent goToLook(const common::Pose2& pose_map, double clearance_m, common::FlightMode mode) {
  common::GoToIntent intent;
  intent.goal_map_m = pose_map.position_m();
  intent.yaw_map_rad = pose_map.yaw_rad;
  intent.tolerance_m = kLookTolerance_m;
  intent.clearance_m = clearance_m;
  intent.mode = mode;
  return intent;
}

}  // namespace

tree::PortManifest LookingLeaf::rangePort() {
  return {.name = "range_m",
          .type = tree::PortType::kDouble,
          .default_value = "3.0",
          .minimum = 1.8,
          .maximum = 20.0,
          .description = "A place counts as seen by the camera from at most this far."};
}

void LookingLeaf::onStart(tree::TickContext& context) {
  FlightLeaf::onStart(context);
  look_.reset();
}

void LookingLeaf::onResume(tree::TickContext& context) {
  FlightLeaf::onResume(context);
  look_.reset();
}

void LookingLeaf::see(const FlightTick& tick, double range_m) {
  const common::World& world = *tick.flight.world;
  if (world.map3d) seen_.see(*world.map3d, *world.map->grid, range_m);
}

bool LookingLeaf::lookOn(FlightTick& tick, const SearchArea& area) {
  if (looks_since_ && look_) {
    emitHold(tick);
    if ((tick.flight.now - *looks_since_).seconds() < kLookingTime_s) return true;
    seen_.giveUp(look_->place_map_m);
    look_.reset();
    return true;
  }
  if (look_ && seen_.isSeen(look_->place_map_m)) look_.reset();  // On the way there.
  if (!look_) {
    const common::World& world = *tick.flight.world;
    look_ = seen_.next(world.vehicle->state.T_map_body_planar().position_m(), *world.map->grid,
                       tick.flight.goal_map.get(), area);
    looks_since_.reset();
    renewIntent();
    if (!look_) return false;
  }
  emitIntent(tick, goToLook(look_->from_map, area.clearance_m, tick.mode));
  if (intentState(tick) == common::IntentState::kSucceeded) looks_since_ = tick.flight.now;
  if (intentState(tick) == common::IntentState::kFailed) {
    seen_.giveUp(look_->place_map_m);
    look_.reset();
  }
  return true;
}

}  // namespace swiftlet::behaviors
