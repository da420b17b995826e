// The vehicle in the simulator: the same interface a real one has, plus the truth for the scorer.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/vehicle.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/scenario.hpp"
#include "simulation/truth.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

/// Always lockstep: time passes in advanceTo alone. Physics at 1 kHz, attitude loop at 500 Hz, hull swept at 100 Hz.
/// Everything random is drawn from streams named by (seed, sensor, frame): who looks at what changes nothing.
class SimulatedVehicle final : public common::Vehicle {
 public:
  /// Applies the scenario's variation by its seed. Throws common::InputError when there is no floor under the start,
  /// the start is inside a wall, a model to be shifted does not exist, or no draw leaves the goals reachable.
  SimulatedVehicle(WorldModel world, const Scenario& scenario);
  ~SimulatedVehicle() override;

  common::Time now() const override;
  [[nodiscard]] bool advanceTo(common::Time time, std::vector<common::SensorEvent>& events) override;
  void apply(const common::Setpoint& setpoint) override;
  std::string stopReason() const override;

  /// Whether camera frames are rendered and delivered from now on; at first they are not.
  void setCameraConsumer(bool wanted);

  const Truth& truth() const;
  /// The frame the autonomy calls `map`: the take-off place on its floor, with the yaw of the start.
  common::Pose3 T_world_map() const;
  /// The world after the seed's variation, and rays in it.
  const WorldModel& world() const;
  const RayCaster& rays() const;
  /// The scenario as flown: start, wind and battery after the variation.
  const Scenario& scenario() const;
  /// How many draws of the variation were refused.
  int redraws() const;
  /// Where the walkers are now.
  std::vector<Actor> walkers() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::simulation
