// The arena: a world with its rays, wind, people, doors and clock, and the vehicles in it. Time advances in fixed steps
// for all of them together, in the same order in each step: wind, flight, people, doors, contacts, sensors.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/sensor_event.hpp"
#include "common/vehicle.hpp"
#include "simulation/doors.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/scenario.hpp"
#include "simulation/vehicle_model.hpp"
#include "simulation/walkers.hpp"
#include "simulation/wind.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

/// Vehicles are numbered in the order of the scenario. A second vehicle has no effect on the first until they meet:
/// the world, the wind and the first vehicle's start and noise are drawn as if it were alone.
///
/// An attended vehicle has an owner that advances it and applies its setpoints; the others stay where they start. All
/// attended vehicles pass through the same instants. The first that is advanced to an instant moves the arena there;
/// the others must be advanced to the same instant, in any order, before any of them is advanced further. A setpoint
/// must be applied before any vehicle is advanced further. SWIFTLET_CHECK enforces all of this. So each setpoint is
/// known before the step that needs it, and the order of the vehicles has no effect. The arena does not wait for a
/// vehicle that has crashed or is no longer attended.
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

  /// The last instant that a vehicle was advanced to. While any vehicle flies, the physics is less than a step behind.
  common::Time now() const { return now_; }
  /// The world after the seed's variation, and rays in it.
  const WorldModel& world() const { return world_; }
  const RayCaster& rays() const { return rays_; }
  /// The present positions of the people.
  const std::vector<Actor>& people() const { return people_; }

  std::size_t vehicleCount() const { return seats_.size(); }
  /// `index` is below vehicleCount().
  const VehicleModel& vehicle(std::size_t index) const { return *seats_.at(index).model; }

  // For SimulatedVehicle.

  /// Call it at time 0, once for a vehicle. From then until `leave` the arena waits for this vehicle and its sensors
  /// measure.
  void attend(std::size_t index);
  void leave(std::size_t index);
  /// The instant that the vehicle was advanced to, or that of its contact once it has crashed.
  common::Time nowOf(std::size_t index) const { return seats_.at(index).now; }
  /// As common::Vehicle::advanceTo.
  [[nodiscard]] bool advance(std::size_t index, common::Time time, std::vector<common::SensorEvent>& events);
  void apply(std::size_t index, const common::Setpoint& setpoint);
  void tellPhase(std::size_t index, std::vector<std::string> words);
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
  void addDoors(const Scenario& scenario);
  void stepTo(common::Time time);
  void step();
  void stepPeople();
  void judgeMeetings();
  bool anyFlown() const;
  void stepDoors();
  /// What the rays of a vehicle may hit besides the world: people, closed doors and other vehicles.
  const std::vector<Actor>& aroundVehicle(std::size_t index);

  WorldModel world_;
  RayCaster rays_;
  Wind wind_;
  std::vector<Seat> seats_;
  std::vector<Walker> walkers_;
  std::vector<Door> doors_;
  std::vector<std::size_t> walked_around_;  ///< For each walker, the vehicle that it crosses or follows.
  std::vector<Actor> people_;
  std::vector<Actor> around_;  ///< Kept between steps to save the allocation.
  common::Time stepped_;       ///< The end of the last physics step.
  common::Time now_;
  std::uint64_t step_ = 0;
};

}  // namespace swiftlet::simulation
