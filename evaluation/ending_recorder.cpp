#include "evaluation/ending_recorder.hpp"

#include <utility>

#include "common/world.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/vehicle_layer.hpp"
#include "simulation/sensors/sensor_config.hpp"

namespace swiftlet::evaluation {

using common::Time;

void EndingRecorder::tick(const simulation::Truth& truth, double position_error_m) {
  if (truth.airborne && !record_.flew) {
    record_.flew = true;
    record_.charge_at_take_off = truth.battery_remaining;
  }
  if (truth.airborne && last_ && last_->airborne) airborne_s_ += (truth.stamp - last_->stamp).seconds();
  const bool in_mission = runs_ && truth.airborne;
  if (in_mission || !has_run_) {
    record_.then = truth;
    record_.position_error_m = position_error_m;
    record_.airborne_until_then_s = airborne_s_;
  }
  if (in_mission) {
    has_run_ = true;
    followTrail(truth);
  }
  if (truth.failed_sensor && (truth.stamp - record_.then.stamp).seconds() <= EndingRecord::kAround_s) {
    faulty_at_ = truth.stamp;
    record_.faulty_sensor = toString(*truth.failed_sensor);
  }
  last_ = truth;
}

void EndingRecorder::followTrail(const simulation::Truth& truth) {
  if (trail_.empty() || (truth.stamp - trail_.back().first).seconds() >= EndingRecord::kTrailPeriod_s)
    trail_.emplace_back(truth.stamp, truth.T_world_body.position_m);
  while ((truth.stamp - trail_.front().first).seconds() > EndingRecord::kTrail_s) trail_.pop_front();
}

void EndingRecorder::intent(const common::Intent& intent, const common::IntentStatus& status) {
  const auto* go_to = std::get_if<common::GoToIntent>(&intent.kind);
  if (go_to == nullptr || status.id != intent.id) return;
  record_.failed_goal_map_m.reset();
  if (status.state != common::IntentState::kFailed) return;
  record_.failed_goal_map_m = go_to->goal_map_m;
  if (last_) record_.doors_at_failed_goal = last_->closed_doors;
}

void EndingRecorder::world(const common::World& world) {
  runs_ = world.mission->status.state == common::MissionState::kRunning &&
          world.vehicle->flight_state == common::FlightState::kFlying;
}

void EndingRecorder::order(Time now, std::string text) {
  ordered_at_ = now;
  record_.order = std::move(text);
}

EndingRecord EndingRecorder::finish() const {
  EndingRecord record = record_;
  const auto isAround = [&](const std::optional<Time>& stamp) {
    return stamp && (record.then.stamp - *stamp).seconds() <= EndingRecord::kAround_s;
  };
  if (!isAround(faulty_at_)) record.faulty_sensor.clear();
  if (!isAround(ordered_at_)) record.order.clear();
  for (const auto& [stamp, position_world_m] : trail_) record.trail_world_m.push_back(position_world_m);
  return record;
}

}  // namespace swiftlet::evaluation
