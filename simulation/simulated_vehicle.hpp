// A vehicle in the simulator: the same interface a real one has, plus the truth for the scorer.
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

class Arena;

/// Attends one vehicle of an arena for its whole lifetime. Always lockstep: time passes only in advanceTo, and the
/// vehicles of one arena pass through the same instants (see Arena). Physics at 1 kHz, attitude loop at 500 Hz, hull
/// swept at 100 Hz. Everything random is drawn from streams named by (seed, sensor, frame), with a separate seed for
/// each vehicle, so that viewers and other vehicles change nothing.
class SimulatedVehicle final : public common::Vehicle {
 public:
  /// Vehicle number `index` of the arena. No time may have passed in the arena, and no other object may attend the
  /// vehicle.
  SimulatedVehicle(std::shared_ptr<Arena> arena, std::size_t index);
  /// The first vehicle of an arena that this object owns. Throws what Arena throws.
  SimulatedVehicle(const WorldModel& world, const Scenario& scenario);
  /// The attended vehicle stays in the arena, with its last setpoint and the autopilot's rule for a lost link.
  ~SimulatedVehicle() override;
  SimulatedVehicle(const SimulatedVehicle&) = delete;
  SimulatedVehicle& operator=(const SimulatedVehicle&) = delete;

  common::Time now() const override;
  [[nodiscard]] bool advanceTo(common::Time time, std::vector<common::SensorEvent>& events) override;
  void apply(const common::Setpoint& setpoint) override;
  std::string stopReason() const override;

  /// Whether camera frames are rendered and delivered from now on; initially they are not.
  void setCameraConsumer(bool wanted);

  /// What an observer says about the flight from now on, for faults that begin in a phase: the flight's state, the
  /// mission's phase, the running behaviours.
  void tellPhase(std::vector<std::string> words);

  /// The scenario's name for the vehicle; empty for a single vehicle without a name.
  const std::string& name() const;
  const Truth& truth() const;
  /// The frame the autonomy calls `map`: at the take-off place on its floor, with the yaw of the start.
  common::Pose3 T_world_map() const;
  /// The true pose in that frame.
  common::Pose3 trueT_map_body() const { return T_world_map().inverse() * truth().T_world_body; }
  /// The world after the seed's variation, and the rays in it.
  const WorldModel& world() const;
  const RayCaster& rays() const;
  /// The scenario as flown by this vehicle: start, wind and battery after the variation.
  const Scenario& scenario() const;
  /// Number of draws of the variation that were refused.
  int redraws() const;
  /// Present positions of the walkers.
  std::vector<Actor> walkers() const;

 private:
  std::shared_ptr<Arena> arena_;
  std::size_t index_;
};

}  // namespace swiftlet::simulation
