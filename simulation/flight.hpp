// Time in the simulator: one fixed step after the other, each in the same order: commands, autopilot, wind, physics,
// people, referee, sensors.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "common/sensor_event.hpp"
#include "common/vehicle.hpp"
#include "simulation/autopilot.hpp"
#include "simulation/quadrotor.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/referee.hpp"
#include "simulation/sensors/link.hpp"
#include "simulation/sensors/sensor_suite.hpp"
#include "simulation/truth.hpp"
#include "simulation/variation.hpp"
#include "simulation/walkers.hpp"
#include "simulation/wind.hpp"

namespace swiftlet::simulation {

class Flight {
 public:
  explicit Flight(Realization realization);
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;

  common::Time now() const { return now_; }
  [[nodiscard]] bool advanceTo(common::Time time, std::vector<common::SensorEvent>& events);
  void apply(const common::Setpoint& setpoint);
  void setCameraConsumer(bool wanted) { sensors_.setCameraConsumer(wanted); }

  const Truth& truth() const { return truth_; }
  const Realization& realization() const { return realization_; }
  const RayCaster& rays() const { return rays_; }
  const std::vector<Actor>& actors() const { return actors_; }

 private:
  void step();
  void stepAutopilot();
  void stepWalkers();
  void push();
  void updateTruth();

  Realization realization_;
  RayCaster rays_;
  Quadrotor quadrotor_;
  Autopilot autopilot_;
  Wind wind_;
  std::vector<Walker> walkers_;
  Referee referee_;
  SensorSuite sensors_;
  Link command_link_;
  std::uint64_t commands_ = 0;
  std::deque<std::pair<common::Time, common::Setpoint>> commands_under_way_;
  std::array<double, 4> throttles_{};
  std::vector<Actor> actors_;
  Truth truth_;
  common::Time stepped_;  ///< The last physics step.
  common::Time now_;      ///< What was asked for; less than a step later.
  std::uint64_t step_ = 0;
};

}  // namespace swiftlet::simulation
