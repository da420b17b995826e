#include "evaluation/flight_recorder.hpp"

#include <algorithm>

#include "common/quantile.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Pose3;
using common::Time;

/// Slow enough that two views differ, fast enough that nothing is in view for less.
constexpr auto kViewPeriod = common::Duration::fromMilliseconds(200);
/// A goal this near to home counts as home.
constexpr double kSamePlace_m = 1e-3;

}  // namespace

FlightRecorder::FlightRecorder(const Pose3& T_world_start, const Pose3& T_world_map,
                               const std::optional<common::Pose2>& T_world_given) {
  record_.estimate = EstimateRecord(T_world_start, T_world_map);
  record_.T_world_start = T_world_start;
  record_.T_world_map = T_world_map;
  if (T_world_given) record_.localization.emplace(*T_world_given);
}

void FlightRecorder::watch(const std::vector<PhaseConfig>& phases) {
  for (const PhaseConfig& phase : phases) phases_.emplace_back(phase);
}

void FlightRecorder::watchEvents(const std::vector<EventOrderConfig>& orders) {
  for (const EventOrderConfig& order : orders) event_orders_.emplace_back(order);
}

void FlightRecorder::event(const common::Event& event) {
  const Eigen::Vector3d place_map_m = record_.estimate.truthInMap(record_.last_truth.T_world_body).position_m;
  for (EventOrderRecorder& order : event_orders_) order.event(event, place_map_m);
}

void FlightRecorder::tickPhases(const simulation::Truth& truth, const common::VehicleState& estimate,
                                const std::optional<Eigen::Vector3d>& reference_odom_m) {
  const PhaseTick tick{truth.stamp, record_.estimate.truthInMap(truth.T_world_body),
                       record_.T_world_map.rotation.conjugate() * truth.velocity_world_m_s, estimate, reference_odom_m};
  for (PhaseRecorder& phase : phases_) {
    if (truth.airborne)
      phase.tick(tick);
    else
      phase.stand();
  }
}

void FlightRecorder::followPath(const simulation::Truth& truth) {
  if (first_tick_ && truth.airborne)
    record_.true_distance_m +=
        (truth.T_world_body.position_m - record_.last_truth.T_world_body.position_m).head<2>().norm();
  if (!first_tick_) first_tick_ = truth.stamp;
  record_.last_truth = truth;
  record_.flight_time_s = (truth.stamp - *first_tick_).seconds();
  if (!truth.airborne) return;
  record_.true_speed_max_m_s = std::max(record_.true_speed_max_m_s, truth.velocity_world_m_s.head<2>().norm());
  heights_world_m_.push_back(truth.T_world_body.position_m.z());
  if (truth.stamp < next_view_) return;
  record_.T_world_body_views.push_back(truth.T_world_body);
  next_view_ = truth.stamp + kViewPeriod;
}

void FlightRecorder::tick(const simulation::Truth& truth, const common::VehicleState& estimate,
                          const std::optional<Eigen::Vector3d>& reference_odom_m) {
  conduct_.tick(truth);
  contact_.tick(truth);
  behaviors_.tick(truth, record_.estimate.truthInMap(truth.T_world_body), record_.T_world_map);
  tickPhases(truth, estimate, reference_odom_m);
  followPath(truth);
  record_.estimate.tick(truth, estimate);
  const ComparedEstimate& newest = record_.estimate.newest();
  ending_.tick(truth, (newest.T_map_body.position_m() - newest.T_map_truth.position_m()).norm());
}

void FlightRecorder::intent(Time now, const common::Intent& intent, const common::IntentStatus& status) {
  const auto* go_to = std::get_if<common::GoToIntent>(&intent.kind);
  const bool home = go_to != nullptr && (go_to->goal_map_m - home_map_m_).norm() < kSamePlace_m;
  conduct_.intent(intent, status, home);
  ending_.intent(intent, status);
  contact_.intent(intent);
  behaviors_.intent(intent, status);
  if (go_to == nullptr || status.id != intent.id || status.state != common::IntentState::kSucceeded) return;
  if (counted_intent_ == intent.id) return;
  const std::optional<Pose3> T_world_body = record_.estimate.truthAt(now);
  if (!T_world_body) return;
  counted_intent_ = intent.id;
  const auto errorIn = [&](const Pose3& T_world_frame) {
    if (go_to->goal_given_m && record_.localization)
      return (record_.localization->T_given_world * T_world_body->position_m.head<2>() - *go_to->goal_given_m).norm();
    const Eigen::Vector2d truth_m = (T_world_frame.inverse() * T_world_body->position_m).head<2>();
    return (truth_m - go_to->goal_map_m).norm();
  };
  record_.goals.push_back({now, home, go_to->goal_map_m, errorIn(record_.T_world_map), record_.estimate.newest(),
                           errorIn(record_.T_world_start)});
}

void FlightRecorder::world(const common::World& world) {
  conduct_.world(world);
  behaviors_.world(world);
  ending_.world(world);
  contact_.world(world);
  for (PhaseRecorder& phase : phases_) phase.world(world);
  home_map_m_ = world.vehicle->home_map.position_m();
  record_.map = world.map->grid;
  record_.map3d = world.map3d;
  record_.explored_area_m2 = world.map->explored_area_m2;
  if (record_.localization)
    record_.localization->world(world, record_.estimate.truthAt(world.vehicle->state.stamp), record_.true_distance_m);
  record_.mission.world(world);
}

FlightRecord FlightRecorder::finish() const {
  FlightRecord record = record_;
  record.conduct = conduct_.finish();
  record.behaviors = behaviors_.record();
  record.ending = ending_.finish();
  record.contact = contact_.finish();
  record.motors_off = contact_.motorsOff();
  for (const PhaseRecorder& phase : phases_) record.phases.push_back(phase.finish());
  for (const EventOrderRecorder& order : event_orders_) record.event_orders.push_back(order.finish());
  if (!heights_world_m_.empty()) record.cruise_height_world_m = common::quantile(heights_world_m_, 0.5);
  return record;
}

}  // namespace swiftlet::evaluation
