// The numbers of a scenario's plant by their keys ("quadrotor.motor_lag_s"), for callers that turn one of them by its
// name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config_fields.hpp"
#include "simulation/scenario.hpp"

namespace swiftlet::simulation {

/// Describes the settings of a scenario that are its plant: what vehicle, sensors and air are like. The rest, for
/// example the world and the walkers, is the flight.
void describePlant(Scenario& scenario, common::config::Fields& fields);

struct PlantKey {
  std::string key;
  double value = 0.0;
  common::config::Bounds bounds = common::config::kFinite;
  bool whole = false;  ///< It counts something.
};

/// In the order of the reference. Keys inside of lists are left out.
std::vector<PlantKey> plantKeys(const Scenario& scenario);

/// nullopt if there is no such number.
std::optional<PlantKey> plantKey(const Scenario& scenario, const std::string& key);

/// Sets the number of a key, which must exist, as if the scenario's file had written it out: no nature changes it. The
/// charge, `battery_remaining`, is set for every vehicle, and no longer varies.
void setPlantKey(Scenario& scenario, const std::string& key, double value);

}  // namespace swiftlet::simulation
