#include "autonomy/autonomy.hpp"

#include <algorithm>
#include <utility>

#include "autonomy/snapshot.hpp"
#include "control/flight_state_machine.hpp"

namespace swiftlet::autonomy {

using common::FlightState;
using common::Time;

Autonomy::Autonomy(AutonomySetup setup)
    : vehicle_name_(std::move(setup.vehicle_name)),
      vehicle_kind_(setup.vehicle.name),
      senses_(setup.config, setup, log_),
      commander_(setup.config, setup, log_),
      navigator_(setup.config, setup, log_),
      jobs_(std::move(setup.jobs)),
      world_builder_(vehicle_name_) {
  world_ = snapshot(senses_.start(navigator_.feedback()));
}

Autonomy::~Autonomy() = default;

std::optional<common::Setpoint> Autonomy::process(const Input& input) {
  if (!std::exchange(heard_, true)) senses_.hear(navigator_.feedback());
  if (const auto* timer = std::get_if<Tick>(&input)) return tick(timer->now);
  if (const auto* event = std::get_if<common::SensorEvent>(&input)) take(*event);
  if (const auto* order = std::get_if<CommandInput>(&input))
    commander_.take(order->command, order->taken, *world_, navigator_);
  if (const auto* delivery = std::get_if<common::JobDelivery>(&input)) jobs_->deliver(*delivery);
  return std::nullopt;
}

/// A frame of the observing camera has no effect here. It is an input so that recordings contain it.
void Autonomy::take(const common::SensorEvent& event) {
  if (!senses_.sense(event)) return;
  if (const auto* pilot = std::get_if<common::PilotSample>(&event)) {
    commander_.pilotArrived(*pilot);
    navigator_.pilotArrived(*pilot);
  }
}

common::Setpoint Autonomy::tick(Time now) {
  const Percept percept = senses_.sense(now);
  navigator_.react(percept, commander_.keepOut());
  if (percept.around) world_ = snapshot(percept);
  const Decision& decision = commander_.decide(percept, world_, navigator_);
  // So that the last snapshot shows how the mission ended.
  if (percept.around && decision.mission_over) world_ = snapshot(percept);
  const common::Setpoint setpoint = navigator_.fly(decision, percept, commander_.keepOut());
  heard_ = false;
  return setpoint;
}

std::shared_ptr<const common::World> Autonomy::snapshot(const Percept& percept) {
  return world_builder_.build(percept.now, partsOf(percept, commander_, navigator_, world_.get()));
}

bool Autonomy::finished() const {
  const FlightState flight = navigator_.controller().state();
  return commander_.missionOver() && (flight == FlightState::kPoweredOff || flight == FlightState::kPreparation);
}

VehicleMemory Autonomy::learned() const {
  return {VehicleMemory::kVersion, vehicle_kind_, navigator_.controller().thrust().table().points()};
}

AutonomyCounts Autonomy::counts() const {
  return {senses_.lateScans(), senses_.estimator().counts(), navigator_.executor().desk().use()};
}

std::vector<common::Event> Autonomy::takeEvents() {
  std::vector<common::Event> events = log_.take();
  std::ranges::stable_sort(events, {}, &common::Event::stamp);
  return events;
}

}  // namespace swiftlet::autonomy
