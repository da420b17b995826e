// The arena: a world with its rays, its air, its people and its clock, and the vehicles in it. Time goes in one fixed
// step after the other, for all of them together and each in the same order: air, flight, people, contacts, sensors.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/sensor_event.hpp"
#include "common/vehicle.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/scenario.hpp"
#include "simulation/vehicle_model.hpp"
#include "simulation/walkers.hpp"
#include "simulation/wind.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

/// Vehicles are numbered in the order of the scenario. A second one shifts nothing of the first until they meet: the
/// world, the wind and the first vehicle's start and noise are drawn as if it were alone.
///
/// Who advances: a vehicle that is attended has somebody who advances it and applies its setpoints; the others stand
/// where they start. All attended vehicles pass through the same instants. The first that asks for an instant moves the
/// arena there; the others must ask for the same one, in any order, before any of them asks for a later one. A setpoint
/// is handed over between being advanced to an instant and anybody asking for a later one (SWIFTLET_CHECK, all of it).
/// So each setpoint is known before the step that needs it, and the order of the vehicles changes nothing. A vehicle
/// that has crashed, or that nobody attends any more, is not waited for.
///
/// Called from one thread.
class Arena {
 public:
  /// Applies the scenario's variation by its seed. Throws common::InputError when there is no floor under a start, a
  /// start is inside a wall or another vehicle, a model to be shifted does not exist, or no draw leaves the goals
  /// reachable.
  Arena(const WorldModel& world, const Scenario& scenario);
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  ~Arena();

  /// The last instant that was asked for; the physics has come to less than a step before it.
  common::Time now() const { return now_; }
  /// The world after the seed's variation, and rays in it.
  const WorldModel& world() const { return world_; }
  const RayCaster& rays() const { return rays_; }
  /// Where the people are now.
  const std::vector<Actor>& people() const { return people_; }

  std::size_t vehicleCount() const { return seats_.size(); }
  /// `index` is below vehicleCount().
  const VehicleModel& vehicle(std::size_t index) const { return *seats_.at(index).model; }

  // For SimulatedVehicle.

  /// From the start on, until `leave`, the arena waits for this vehicle and its sensors measure. Nobody else attends
  /// it.
  void attend(std::size_t index);
  void leave(std::size_t index);
  /// The instant the vehicle was advanced to; that of its contact once it has crashed.
  common::Time nowOf(std::size_t index) const { return seats_.at(index).now; }
  /// As common::Vehicle::advanceTo.
  [[nodiscard]] bool advance(std::size_t index, common::Time time, std::vector<common::SensorEvent>& events);
  void apply(std::size_t index, const common::Setpoint& setpoint);
  void setCameraConsumer(std::size_t index, bool wanted);

 private:
  struct Seat {
    std::unique_ptr<VehicleModel> model;
    common::Time now;
    bool attended = false;

    bool flown() const { return attended && !model->truth().crashed; }
  };

  Arena(Realization&& realization, const Scenario& scenario);
  void addPeople(const Scenario& scenario);
  void stepTo(common::Time time);
  void step();
  void stepPeople();
  void judgeMeetings();
  bool anyFlown() const;
  /// What the rays of a vehicle meet beside the world: people and other vehicles.
  const std::vector<Actor>& aroundVehicle(std::size_t index);

  WorldModel world_;
  RayCaster rays_;
  Wind wind_;
  std::vector<Seat> seats_;
  std::vector<Walker> walkers_;
  std::vector<std::size_t> walked_around_;  ///< By walker: the vehicle that it crosses or follows.
  std::vector<Actor> people_;
  std::vector<Actor> around_;  ///< Kept between steps to spare the allocation.
  common::Time stepped_;       ///< The last physics step.
  common::Time now_;
  std::uint64_t step_ = 0;
};

}  // namespace swiftlet::simulation
