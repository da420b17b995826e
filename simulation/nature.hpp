// A nature: how a real vehicle and its sensors differ from their data sheets. A file of config/nature has the keys of a
// scenario, with a range [low, high] where a scenario has a number; each seed draws from the ranges. Only the simulator
// reads natures: the autonomy has the data sheets, not the true plant values.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "simulation/nature_range.hpp"
#include "simulation/scenario.hpp"

namespace swiftlet::simulation {

class NatureRanges;

/// Immutable; safe to share between threads.
class Nature {
 public:
  /// The plant of the defaults: no value is drawn.
  static Nature calm();
  /// `name` is that of a file config/nature/NAME.yaml, or a file. Throws common::InputError with file, line and key:
  /// for unknown keys (with "did you mean"), values out of bounds and ranges that are upside down.
  static Nature load(const std::string& name);
  /// `name` stands for the file in messages.
  static Nature fromText(const std::string& text, const std::string& name);

  const std::string& name() const { return name_; }

  /// This nature with another range of the charge at the start, if the charge is drawn.
  Nature withCharge(double low, double high) const;

  /// The range of a key ("quadrotor.mass_share"); both ends are equal if it is fixed. nullopt if this
  /// nature leaves it as it is.
  std::optional<NatureRange> rangeOf(const std::string& key) const;

  /// The scenario of one vehicle with this nature's values in it. A key that the scenario's own file wrote out
  /// (Scenario::written) keeps its value. Each key draws from a random stream of its own, so that a further key, or one
  /// written out, shifts no other draw.
  ///
  /// A nature that draws the charge replaces the scenario's `variation.battery_remaining`, which then has no effect.
  ///
  /// The draw can fly: at kFullThrottle and the drawn charge the thrust is `least_thrust_over_weight` times the weight,
  /// or the charge is raised until it is; where even a full battery is too weak, all is drawn again. Throws
  /// common::InputError when no draw can fly. A charge that the scenario wrote out is never raised.
  Scenario drawn(const Scenario& scenario, std::uint64_t seed) const;

  /// The greatest throttle that the position controller commands (ThrustModel): the rest is left to the attitude.
  static constexpr double kFullThrottle = 0.95;

  /// The nature's keys with the values that a drawn scenario has, itself a nature's file: a flight in it has the same
  /// plant. Empty if this nature has no keys.
  std::string valuesIn(const Scenario& drawn) const;

 private:
  Nature(std::string name, std::shared_ptr<const NatureRanges> ranges);

  std::string name_;
  std::shared_ptr<const NatureRanges> ranges_;  ///< Null: no value is drawn.
};

}  // namespace swiftlet::simulation
