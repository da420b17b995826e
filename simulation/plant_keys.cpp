#include "simulation/plant_keys.hpp"

#include <utility>

#include "common/check.hpp"
#include "common/config_numbers.hpp"

namespace swiftlet::simulation {
namespace {

using common::config::Bounds;
using common::config::NumberVisitor;

constexpr const char* kChargeKey = "battery_remaining";

}  // namespace

void describePlant(Scenario& scenario, common::config::Fields& fields) {
  fields(kChargeKey, scenario.battery_remaining, {0.01, 1}, "Charge at the start.");
  fields.section("wind", scenario.wind, "Wind.");
  fields.section("quadrotor", scenario.quadrotor, "The airframe's physics.");
  fields.section("autopilot", scenario.autopilot, "The inner loop.");
  fields.section("sensors", scenario.sensors, "Errors and delays of the sensors.");
}

std::vector<PlantKey> plantKeys(const Scenario& scenario) {
  std::vector<PlantKey> keys;
  NumberVisitor visitor([&keys](const std::string& key, double& value, const Bounds& bounds, bool whole) {
    keys.push_back({key, value, bounds, whole});
  });
  Scenario copy = scenario;
  describePlant(copy, visitor);
  return keys;
}

std::optional<PlantKey> plantKey(const Scenario& scenario, const std::string& key) {
  for (PlantKey& one : plantKeys(scenario))
    if (one.key == key) return std::move(one);
  return std::nullopt;
}

void setPlantKey(Scenario& scenario, const std::string& key, double value) {
  if (key == kChargeKey) return scenario.setCharge(value);
  bool found = false;
  NumberVisitor visitor([&](const std::string& one, double& number, const Bounds&, bool) {
    if (one != key) return;
    number = value;
    found = true;
  });
  describePlant(scenario, visitor);
  SWIFTLET_CHECK(found, key);
  scenario.written.push_back(key);
}

}  // namespace swiftlet::simulation
