#include "simulation/simulated_vehicle.hpp"

#include <utility>

#include "simulation/arena.hpp"

namespace swiftlet::simulation {

SimulatedVehicle::SimulatedVehicle(std::shared_ptr<Arena> arena, std::size_t index)
    : arena_(std::move(arena)), index_(index) {
  arena_->attend(index_);
}
SimulatedVehicle::SimulatedVehicle(const WorldModel& world, const Scenario& scenario)
    : SimulatedVehicle(std::make_shared<Arena>(world, scenario), 0) {}
SimulatedVehicle::~SimulatedVehicle() { arena_->leave(index_); }

common::Time SimulatedVehicle::now() const { return arena_->nowOf(index_); }
bool SimulatedVehicle::advanceTo(common::Time time, std::vector<common::SensorEvent>& events) {
  return arena_->advance(index_, time, events);
}
void SimulatedVehicle::apply(const common::Setpoint& setpoint) { arena_->apply(index_, setpoint); }
std::string SimulatedVehicle::stopReason() const { return truth().crash_reason; }
void SimulatedVehicle::tellPhase(std::vector<std::string> words) { arena_->tellPhase(index_, std::move(words)); }
void SimulatedVehicle::setCameraConsumer(bool wanted) { arena_->setCameraConsumer(index_, wanted); }
const std::string& SimulatedVehicle::name() const { return arena_->vehicle(index_).placed().name; }
const Truth& SimulatedVehicle::truth() const { return arena_->vehicle(index_).truth(); }
common::Pose3 SimulatedVehicle::T_world_map() const { return arena_->vehicle(index_).placed().T_world_map; }
const WorldModel& SimulatedVehicle::world() const { return arena_->world(); }
const RayCaster& SimulatedVehicle::rays() const { return arena_->rays(); }
const Scenario& SimulatedVehicle::scenario() const { return arena_->vehicle(index_).placed().scenario; }
int SimulatedVehicle::redraws() const { return arena_->vehicle(index_).placed().redraws; }
std::vector<Actor> SimulatedVehicle::walkers() const { return arena_->people(); }

}  // namespace swiftlet::simulation
