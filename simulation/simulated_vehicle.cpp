#include "simulation/simulated_vehicle.hpp"

#include "simulation/flight.hpp"

namespace swiftlet::simulation {

struct SimulatedVehicle::Impl {
  Impl(WorldModel world, const Scenario& scenario) : flight(realize(world, scenario)) {}
  Flight flight;
};

SimulatedVehicle::SimulatedVehicle(WorldModel world, const Scenario& scenario)
    : impl_(std::make_unique<Impl>(std::move(world), scenario)) {}
SimulatedVehicle::~SimulatedVehicle() = default;

common::Time SimulatedVehicle::now() const { return impl_->flight.now(); }
bool SimulatedVehicle::advanceTo(common::Time time, std::vector<common::SensorEvent>& events) {
  return impl_->flight.advanceTo(time, events);
}
void SimulatedVehicle::apply(const common::Setpoint& setpoint) { impl_->flight.apply(setpoint); }
std::string SimulatedVehicle::stopReason() const { return impl_->flight.truth().crash_reason; }
void SimulatedVehicle::setCameraConsumer(bool wanted) { impl_->flight.setCameraConsumer(wanted); }
const Truth& SimulatedVehicle::truth() const { return impl_->flight.truth(); }
common::Pose3 SimulatedVehicle::T_world_map() const { return impl_->flight.realization().T_world_map; }
const WorldModel& SimulatedVehicle::world() const { return impl_->flight.realization().world; }
const RayCaster& SimulatedVehicle::rays() const { return impl_->flight.rays(); }
const Scenario& SimulatedVehicle::scenario() const { return impl_->flight.realization().scenario; }
int SimulatedVehicle::redraws() const { return impl_->flight.realization().redraws; }
std::vector<Actor> SimulatedVehicle::walkers() const { return impl_->flight.actors(); }

}  // namespace swiftlet::simulation
