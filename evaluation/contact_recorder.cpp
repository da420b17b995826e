#include "evaluation/contact_recorder.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/world.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::evaluation {
namespace {

using common::FlightState;

/// Climbed so far, a vehicle that takes off no longer stands because it has not left the floor yet.
constexpr double kLifted_m = 0.1;

}  // namespace

bool ContactRecorder::mayStand() const {
  if (piloted_) return true;
  return flight_ == FlightState::kTakingOff ? !lifted_ : flight_ != FlightState::kFlying;
}

void ContactRecorder::tick(const simulation::Truth& truth) {
  followCharge(truth);
  followMotion(truth);
  const Eigen::Vector3d& position = truth.T_world_body.position_m;
  const bool stands = !truth.airborne, means_to_fly = !mayStand();
  if (stands && !means_to_fly) {
    next_.stood_world_m = position;
    lifted_ = false;
  } else if (!stands && position.z() > next_.stood_world_m.z() + kLifted_m) {
    lifted_ = true;
  }
  if (truth.crashed)
    begin(truth, truth.crash_reason);
  else if (stands && means_to_fly)
    begin(truth,
          fmt::format("stood on the floor at ({:.2f}, {:.2f}, {:.2f})", position.x(), position.y(), position.z()));
  const bool was_on_floor = std::exchange(on_floor_, stands && motors_on_ && (on_floor_ || means_to_fly));
  if (was_on_floor && on_floor_) contact_->floor_s += (truth.stamp - last_tick_).seconds();
  last_tick_ = truth.stamp;
}

void ContactRecorder::followCharge(const simulation::Truth& truth) {
  if (truth.airborne) charges_.push_back({truth.stamp, truth.battery_remaining, truth.lost_cells});
  while (!charges_.empty() && (truth.stamp - charges_.front().stamp).seconds() > ContactRecord::kLanding_s)
    charges_.pop_front();
}

/// People who come or go make another crowd: what was before cannot be compared with it.
void ContactRecorder::followMotion(const simulation::Truth& truth) {
  if (!motion_.empty() && motion_.back().people_world_m.size() != people_world_m_.size()) motion_.clear();
  const Eigen::Vector3d& position = truth.T_world_body.position_m;
  motion_.push_back(
      {truth.stamp, position, truth.velocity_world_m_s, position.z() - next_.stood_world_m.z(), people_world_m_});
  while ((truth.stamp - motion_.front().stamp).seconds() > ContactReplay::kBefore_s) motion_.pop_front();
}

void ContactRecorder::begin(const simulation::Truth& truth, std::string what) {
  if (contact_) return;
  contact_ = next_;
  contact_->what = std::move(what);
  contact_->truth = truth;
  contact_->flight = flight_;
  contact_->motors_off = !motors_on_;
  if (truth.by_walker) {
    const std::vector<ReplayTick> ticks(motion_.begin(), motion_.end());
    contact_->replay = replay(ticks);
  }
  contact_->charge_before = charges_.empty() ? truth.battery_remaining : charges_.front().remaining;
  contact_->lost_cells_before = charges_.empty() ? truth.lost_cells : charges_.front().lost_cells;
}

void ContactRecorder::intent(const common::Intent& intent) {
  if (const auto* take_off = std::get_if<common::TakeOffIntent>(&intent.kind))
    next_.take_off_height_m = take_off->height_m;
}

void ContactRecorder::world(const common::World& world) {
  flight_ = world.vehicle->flight_state;
  piloted_ = world.mission->status.flown_by == common::FlownBy::kPilot;
}

std::optional<ContactRecord> ContactRecorder::finish() const {
  std::optional<ContactRecord> contact = contact_;
  if (contact && contact->floor_s > 0.0)
    contact->what += fmt::format(" for {:.1f} s with its motors on, where it meant to fly", contact->floor_s);
  return contact;
}

}  // namespace swiftlet::evaluation
