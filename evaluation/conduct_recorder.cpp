#include "evaluation/conduct_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/world.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::evaluation {
namespace {

double tiltOf(const common::Pose3& T_world_body) {
  const double up = (T_world_body.rotation * Eigen::Vector3d::UnitZ()).z();
  return std::acos(std::clamp(up, -1.0, 1.0));
}

}  // namespace

void ConductRecorder::tick(const simulation::Truth& truth) {
  const bool was_airborne = last_ && last_->airborne;
  const bool touched_down = was_airborne && !truth.airborne && !truth.crashed;
  if (truth.airborne) {
    const double dt_s = was_airborne ? (truth.stamp - last_->stamp).seconds() : 0.0;
    const double tilt_rad = tiltOf(truth.T_world_body);
    record_.airborne_s += dt_s;
    if (tilt_rad > ConductRecord::kTilted_rad) record_.tilted_s += dt_s;
    record_.tilt_max_rad = std::max(record_.tilt_max_rad, tilt_rad);
    record_.charge_min = std::min(truth.battery_remaining, record_.charge_min.value_or(1.0));
    record_.lost_cells = truth.lost_cells;
  }
  if (touched_down) {
    const double down_m_s = std::max(0.0, -last_->velocity_world_m_s.z());
    record_.touch_down_speed_m_s = std::max(down_m_s, record_.touch_down_speed_m_s.value_or(0.0));
  }
  if (truth.faulty && !(last_ && last_->faulty)) fault_begin_ = truth.stamp;
  last_ = truth;
  followFault();
  followHome(touched_down);
}

/// A vehicle that stands is safe.
void ConductRecorder::followFault() {
  if (!fault_begin_ || !(safe_ || !last_->airborne) || last_->crashed) return;
  record_.safe_action_s = std::max((last_->stamp - *fault_begin_).seconds(), record_.safe_action_s.value_or(0.0));
  fault_begin_.reset();
}

void ConductRecorder::followHome(bool touched_down) {
  if (!touched_down || !home_) return;
  if (home_->arrived && home_->predicted)
    record_.home_energy = {*home_->predicted, home_->charge_at_begin - last_->battery_remaining};
  home_.reset();
}

void ConductRecorder::intent(const common::Intent& intent, const common::IntentStatus& status, bool home) {
  if (!home || !last_) return;
  const bool begins = !home_ || home_->intent != intent.id;
  if (begins && status.state == common::IntentState::kRunning)
    home_ = FlightHome{intent.id, home_share_, last_->battery_remaining, false};
  if (home_ && home_->intent == intent.id && status.id == intent.id && status.state == common::IntentState::kSucceeded)
    home_->arrived = true;
}

void ConductRecorder::world(const common::World& world) {
  using common::FlightState;
  using common::MissionState;
  const FlightState flight = world.vehicle->flight_state;
  const MissionState mission = world.mission->status.state;
  safe_ = flight == FlightState::kLanding || flight == FlightState::kEmergencyLanding ||
          mission == MissionState::kHeld || common::isOver(mission);
  home_share_ = world.energy->home_share;
}

ConductRecord ConductRecorder::finish() const {
  ConductRecord record = record_;
  if (fault_begin_) record.safe_action_s = std::numeric_limits<double>::infinity();
  return record;
}

}  // namespace swiftlet::evaluation
