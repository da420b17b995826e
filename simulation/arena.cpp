#include "simulation/arena.hpp"

#include <algorithm>
#include <utility>

#include "common/check.hpp"
#include "common/random.hpp"
#include "simulation/variation.hpp"

namespace swiftlet::simulation {

using common::Time;

Arena::Arena(const WorldModel& world, const Scenario& scenario) : Arena(realize(world, scenario), scenario) {}

Arena::Arena(Realization&& realization, const Scenario& scenario)
    : world_(std::move(realization.world)),
      rays_(world_),
      wind_(realization.vehicles.front().scenario.wind, scenario.seed) {
  for (PlacedVehicle& placed : realization.vehicles)
    seats_.push_back({std::make_unique<VehicleModel>(std::move(placed), world_, rays_), Time(), false});
  addPeople(scenario);
  addDoors(scenario);
  stepDoors();
  for (std::size_t i = 0; i < seats_.size(); ++i) seats_[i].model->begin(aroundVehicle(i));
}

Arena::~Arena() = default;

void Arena::addPeople(const Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.walkers.size(); ++i) {
    const WalkerConfig& config = scenario.walkers[i];
    walked_around_.push_back(scenario.vehicleNumber(config.vehicle));
    const PlacedVehicle& vehicle = seats_[walked_around_.back()].model->placed();
    walkers_.emplace_back(config, scenario.seed, i, vehicle.T_world_map.position_m.z(),
                          vehicle.scenario.vehicle.hullRadius_m(), rays_);
  }
}

void Arena::addDoors(const Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.doors.size(); ++i) {
    DoorConfig door = scenario.doors[i];
    if (common::RandomStream(scenario.seed, "door", i).chance(door.closed_share)) door.closed_s = {0.0};
    doors_.emplace_back(door, seats_.front().model->placed().T_world_map.position_m.z());
  }
}

void Arena::attend(std::size_t index) {
  SWIFTLET_CHECK(index < seats_.size() && !seats_[index].attended && now_ == Time(), index, now_.seconds());
  seats_[index].attended = true;
}

void Arena::leave(std::size_t index) { seats_.at(index).attended = false; }

bool Arena::advance(std::size_t index, Time time, std::vector<common::SensorEvent>& events) {
  Seat& seat = seats_.at(index);
  SWIFTLET_CHECK(seat.attended, index);
  if (seat.flown() && time > seat.now) {
    if (time > now_) stepTo(time);
    SWIFTLET_CHECK(time == now_, index, time.seconds(), now_.seconds());  // The arena has passed it.
  }
  const Truth& truth = seat.model->truth();
  seat.now = truth.crashed ? truth.stamp : std::max(seat.now, time);
  seat.model->take(seat.now, events);
  return !truth.crashed;
}

void Arena::apply(std::size_t index, const common::Setpoint& setpoint) {
  Seat& seat = seats_.at(index);
  SWIFTLET_CHECK(!seat.flown() || seat.now == now_, index, seat.now.seconds(), now_.seconds());  // Too late.
  seat.model->apply(seat.now, setpoint);
}

void Arena::tellPhase(std::size_t index, std::vector<std::string> words) {
  seats_.at(index).model->tellPhase(std::move(words));
}

void Arena::setCameraConsumer(std::size_t index, bool wanted) { seats_.at(index).model->setCameraConsumer(wanted); }

void Arena::stepTo(Time time) {
  for (const Seat& seat : seats_)  // The next setpoint of a vehicle that is behind would come too late.
    SWIFTLET_CHECK(!seat.flown() || seat.now == now_, seat.model->placed().name, seat.now.seconds(), now_.seconds());
  while (anyFlown() && stepped_ + kStep <= time) step();
  now_ = time;
}

bool Arena::anyFlown() const {
  return std::any_of(seats_.begin(), seats_.end(), [](const Seat& seat) { return seat.flown(); });
}

void Arena::step() {
  if (step_ % kStepsPerLook == 0) wind_.step(step_ / kStepsPerLook, kStep_s * kStepsPerLook);
  for (Seat& seat : seats_) seat.model->fly(stepped_, step_, wind_.velocity_world_m_s());
  stepped_ += kStep;
  ++step_;
  stepPeople();
  if (step_ % kStepsPerLook == 0) stepDoors();
  for (Seat& seat : seats_) seat.model->judge(stepped_, step_, walkers_, doors_);
  if (step_ % kStepsPerLook == 0) judgeMeetings();
  for (std::size_t i = 0; i < seats_.size(); ++i)
    if (seats_[i].attended) seats_[i].model->measure(stepped_, aroundVehicle(i), rays_);
}

void Arena::stepPeople() {
  if (walkers_.empty()) return;
  people_.clear();
  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    walkers_[i].step(stepped_, seats_[walked_around_[i]].model->asWalkedAround(), kStep_s);
    if (walkers_[i].actor()) people_.push_back(*walkers_[i].actor());
  }
}

void Arena::stepDoors() {
  if (doors_.empty()) return;
  std::vector<Actor> hulls;
  for (const Seat& seat : seats_) hulls.push_back(seat.model->hull());
  for (Door& door : doors_) door.step(stepped_, hulls);
}

void Arena::judgeMeetings() {
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    for (std::size_t j = i + 1; j < seats_.size(); ++j) {
      VehicleModel &a = *seats_[i].model, &b = *seats_[j].model;
      const double gap_m = gapBetween_m(a.hull(), b.hull());
      a.judgeMeeting(stepped_, gap_m, b);
      b.judgeMeeting(stepped_, gap_m, a);
    }
  }
}

const std::vector<Actor>& Arena::aroundVehicle(std::size_t index) {
  if (seats_.size() == 1 && doors_.empty()) return people_;
  around_ = people_;
  for (const Door& door : doors_)
    if (door.isClosed()) around_.push_back(door.actor());
  for (std::size_t i = 0; i < seats_.size(); ++i)
    if (i != index) around_.push_back(seats_[i].model->hull());
  return around_;
}

}  // namespace swiftlet::simulation
