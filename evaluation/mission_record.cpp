#include "evaluation/mission_record.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "common/world.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::evaluation {

using common::LocalizationState;

void MissionRecord::world(const common::World& world) {
  const common::MissionStatus& mission = world.mission->status;
  if (common::isOver(state) || mission.state == common::MissionState::kReady) return;
  if (!begin_) begin_ = world.stamp;
  state = mission.state;
  reason = mission.reason;
  time_s = (world.stamp - *begin_).seconds();
  followTree(mission.tree);
}

void MissionRecord::followTree(const common::TreeView& tree) {
  std::map<int, const common::TreeNodeView*> by_id;
  for (const common::TreeNodeView& node : tree) by_id[node.id] = &node;
  const auto isSuspended = [&](int id) {
    const auto found = by_id.find(id);
    return found != by_id.end() && found->second->status == "SUSPENDED";
  };
  for (const common::TreeNodeView& node : tree) {
    if (node.status == "SUSPENDED") {
      if (!isSuspended(node.parent) && suspended_.insert(node.id).second) ++interruptions;
    } else if (suspended_.erase(node.id) > 0 && (node.status == "RUNNING" || node.status == "SUCCESS")) {
      ++resumed;
    }
  }
}

void LocalizationRecord::world(const common::World& world, const std::optional<common::Pose3>& T_world_body,
                               double true_distance_m) {
  if (!world.map->localization) return;
  const common::Localization& localization = *world.map->localization;
  const common::VehicleLayer& vehicle = *world.vehicle;
  const LocalizationState before = std::exchange(state_, localization.state);
  if (before == LocalizationState::kLocalized && state_ == LocalizationState::kLost) ++times_lost;
  if (vehicle.flight_state != common::FlightState::kFlying) {
    last_flown_.reset();
    return;
  }
  const double elapsed_s = last_flown_ ? (world.stamp - *last_flown_).seconds() : 0.0;
  last_flown_ = world.stamp;
  flown_s += elapsed_s;
  if (!localization.localized() || !T_world_body) return;
  const common::Pose2 off = common::between(T_given_world * common::planar(*T_world_body),
                                            localization.T_given_odom * common::planar(vehicle.state.T_odom_body));
  const double error_m = off.position_m().norm(), error_rad = std::abs(off.yaw_rad);
  localized_s += elapsed_s;
  if (error_m > kWrong_m || error_rad > kWrong_rad) wrong_s += elapsed_s;
  if (!found) found = {world.stamp, true_distance_m, error_m, error_rad};
}

}  // namespace swiftlet::evaluation
