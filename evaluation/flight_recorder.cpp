#include "evaluation/flight_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/world.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/vehicle_layer.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Duration;
using common::MissionState;
using common::Pose3;
using common::Time;

/// The truth is kept for as long as an estimate may come late.
constexpr Duration kHistory = Duration::fromMilliseconds(1000);
/// 20 Hz: at 1 m/s a pose every 5 cm.
constexpr Duration kTrajectoryPeriod = Duration::fromMilliseconds(50);
/// Slow enough that two views differ, fast enough that nothing is in view for less.
constexpr Duration kViewPeriod = Duration::fromMilliseconds(200);
/// A goal this near to home counts as home.
constexpr double kSamePlace_m = 1e-3;

}  // namespace

FlightRecorder::FlightRecorder(const Pose3& T_world_start, const Pose3& T_world_map,
                               const std::optional<common::Pose2>& T_world_given) {
  record_.T_world_start = T_world_start;
  record_.T_world_map = T_world_map;
  if (!T_world_given) return;
  T_world_given_ = *T_world_given;
  record_.localization.emplace();
}

void FlightRecorder::watch(const std::vector<PhaseConfig>& phases) {
  for (const PhaseConfig& phase : phases) phases_.emplace_back(phase);
}

void FlightRecorder::tickPhases(const simulation::Truth& truth, const common::VehicleState& estimate,
                                const std::optional<Eigen::Vector3d>& reference_odom_m) {
  const PhaseTick tick{truth.stamp, truthInMap(truth.T_world_body),
                       record_.T_world_map.rotation.conjugate() * truth.velocity_world_m_s, estimate, reference_odom_m};
  for (PhaseRecorder& phase : phases_) {
    if (truth.airborne)
      phase.tick(tick);
    else
      phase.stand();
  }
}

void FlightRecorder::tick(const simulation::Truth& truth, const common::VehicleState& estimate,
                          const std::optional<Eigen::Vector3d>& reference_odom_m) {
  conduct_.tick(truth);
  behaviors_.tick(truth, truthInMap(truth.T_world_body), record_.T_world_map);
  tickPhases(truth, estimate, reference_odom_m);
  if (!first_tick_) first_tick_ = truth.stamp;
  if (!history_.empty() && truth.airborne)
    record_.true_distance_m += (truth.T_world_body.position_m - history_.back().pose.position_m).head<2>().norm();
  if (truth.airborne)
    record_.true_speed_max_m_s = std::max(record_.true_speed_max_m_s, truth.velocity_world_m_s.head<2>().norm());
  if (truth.airborne) heights_world_m_.push_back(truth.T_world_body.position_m.z());
  if (truth.airborne && truth.stamp >= next_view_) {
    record_.T_world_body_views.push_back(truth.T_world_body);
    next_view_ = truth.stamp + kViewPeriod;
  }
  history_.push_back({truth.stamp, truth.T_world_body});
  while (truth.stamp - history_.front().stamp > kHistory) history_.pop_front();
  record_.last_truth = truth;
  record_.flight_time_s = (truth.stamp - *first_tick_).seconds();

  if (!last_estimate_ || estimate.stamp > *last_estimate_) pending_.push_back(estimate);
  last_estimate_ = std::max(estimate.stamp, last_estimate_.value_or(estimate.stamp));
  for (; !pending_.empty() && pending_.front().stamp <= truth.stamp; pending_.pop_front()) {
    const auto T_world_body = common::poseAt(history_, pending_.front().stamp);
    if (!T_world_body) continue;
    newest_ = compared(pending_.front(), *T_world_body);
    if (truth.airborne) compare(pending_.front(), *T_world_body);
  }
  ending_.tick(truth, (newest_.T_map_body.position_m() - newest_.T_map_truth.position_m()).norm());
}

/// The body has the axes of the mounted laser here, as the estimate has: at the take-off it is the identity.
Pose3 FlightRecorder::truthInMap(const Pose3& T_world_body) const {
  const Pose3 T_body_axes = record_.T_world_start.inverse() * record_.T_world_map;
  return record_.T_world_map.inverse() * T_world_body * T_body_axes;
}

void FlightRecorder::compare(const common::VehicleState& estimate, const Pose3& T_world_body) {
  const Pose3 T_map_body = estimate.T_map_body();
  const Pose3 T_map_truth = truthInMap(T_world_body);
  const Pose3 T_start_truth = record_.T_world_start.inverse() * T_world_body;
  const Eigen::Vector3d error_m = T_map_body.position_m - T_map_truth.position_m;
  record_.horizontal_errors_m.push_back(error_m.head<2>().norm());
  record_.horizontal_errors_raw_m.push_back((T_map_body.position_m - T_start_truth.position_m).head<2>().norm());
  record_.spatial_errors_m.push_back(error_m.norm());
  record_.yaw_errors_rad.push_back(
      std::abs(common::wrapAngle(common::yawOf(T_map_body.rotation) - common::yawOf(T_map_truth.rotation))));
  if (next_trajectory_ && estimate.stamp < *next_trajectory_) return;
  next_trajectory_ = estimate.stamp + kTrajectoryPeriod;
  record_.truth_map.push_back({estimate.stamp, T_map_truth});
}

ComparedEstimate FlightRecorder::compared(const common::VehicleState& estimate, const Pose3& T_world_body) const {
  return {common::planar(estimate.T_map_body()), common::planar(estimate.T_odom_body),
          common::planar(truthInMap(T_world_body))};
}

void FlightRecorder::intent(Time now, const common::Intent& intent, const common::IntentStatus& status) {
  const auto* go_to = std::get_if<common::GoToIntent>(&intent.kind);
  const bool home = go_to != nullptr && (go_to->goal_map_m - home_map_m_).norm() < kSamePlace_m;
  conduct_.intent(intent, status, home);
  ending_.intent(intent, status);
  behaviors_.intent(intent, status);
  if (go_to == nullptr || status.id != intent.id || status.state != common::IntentState::kSucceeded) return;
  if (counted_intent_ == intent.id) return;
  const std::optional<Pose3> T_world_body = common::poseAt(history_, now);
  if (!T_world_body) return;
  counted_intent_ = intent.id;
  const auto errorIn = [&](const Pose3& T_world_frame) {
    if (go_to->goal_given_m && record_.localization)
      return (T_world_given_.inverse() * T_world_body->position_m.head<2>() - *go_to->goal_given_m).norm();
    const Eigen::Vector2d truth_m = (T_world_frame.inverse() * T_world_body->position_m).head<2>();
    return (truth_m - go_to->goal_map_m).norm();
  };
  record_.goals.push_back(
      {now, home, go_to->goal_map_m, errorIn(record_.T_world_map), newest_, errorIn(record_.T_world_start)});
}

void FlightRecorder::world(const common::World& world) {
  conduct_.world(world);
  behaviors_.world(world);
  ending_.world(world);
  for (PhaseRecorder& phase : phases_) phase.world(world);
  home_map_m_ = world.vehicle->home_map.position_m();
  record_.map = world.map->grid;
  record_.map3d = world.map3d;
  record_.explored_area_m2 = world.map->explored_area_m2;
  followLocalization(world);
  const common::MissionStatus& mission = world.mission->status;
  if (common::isOver(record_.mission) || mission.state == MissionState::kReady) return;
  if (!mission_begin_) mission_begin_ = world.stamp;
  record_.mission = mission.state;
  record_.mission_reason = mission.reason;
  record_.mission_time_s = (world.stamp - *mission_begin_).seconds();
  followTree(mission.tree);
}

void FlightRecorder::followTree(const common::TreeView& tree) {
  std::map<int, const common::TreeNodeView*> by_id;
  for (const common::TreeNodeView& node : tree) by_id[node.id] = &node;
  const auto isSuspended = [&](int id) {
    const auto found = by_id.find(id);
    return found != by_id.end() && found->second->status == "SUSPENDED";
  };
  for (const common::TreeNodeView& node : tree) {
    if (node.status == "SUSPENDED") {
      if (!isSuspended(node.parent) && suspended_.insert(node.id).second) ++record_.interruptions;
    } else if (suspended_.erase(node.id) > 0 && (node.status == "RUNNING" || node.status == "SUCCESS")) {
      ++record_.resumed;
    }
  }
}

void FlightRecorder::followLocalization(const common::World& world) {
  if (!record_.localization || !world.map->localization) return;
  const common::Localization& localization = *world.map->localization;
  const common::VehicleLayer& vehicle = *world.vehicle;
  LocalizationRecord& record = *record_.localization;
  const common::LocalizationState before = std::exchange(localization_, localization.state);
  if (before == common::LocalizationState::kLocalized && localization_ == common::LocalizationState::kLost)
    ++record.times_lost;
  if (vehicle.flight_state != common::FlightState::kFlying) {
    last_flown_.reset();
    return;
  }
  const double elapsed_s = last_flown_ ? (world.stamp - *last_flown_).seconds() : 0.0;
  last_flown_ = world.stamp;
  record.flown_s += elapsed_s;
  const std::optional<Pose3> T_world_body = common::poseAt(history_, vehicle.state.stamp);
  if (!localization.localized() || !T_world_body) return;
  const common::Pose2 off = common::between(T_world_given_.inverse() * common::planar(*T_world_body),
                                            localization.T_given_odom * common::planar(vehicle.state.T_odom_body));
  const double error_m = off.position_m().norm(), error_rad = std::abs(off.yaw_rad);
  record.localized_s += elapsed_s;
  if (error_m > LocalizationRecord::kWrong_m || error_rad > LocalizationRecord::kWrong_rad) record.wrong_s += elapsed_s;
  if (!record.found) record.found = {world.stamp, record_.true_distance_m, error_m, error_rad};
}

FlightRecord FlightRecorder::finish() const {
  FlightRecord record = record_;
  record.conduct = conduct_.finish();
  record.behaviors = behaviors_.record();
  record.ending = ending_.finish();
  for (const PhaseRecorder& phase : phases_) record.phases.push_back(phase.finish());
  if (!heights_world_m_.empty()) record.cruise_height_world_m = quantile(heights_world_m_, 0.5);
  return record;
}

}  // namespace swiftlet::evaluation
