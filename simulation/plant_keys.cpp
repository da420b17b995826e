#include "simulation/plant_keys.hpp"

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>

#include "common/check.hpp"

namespace swiftlet::simulation {
namespace {

using common::config::Bounds;

constexpr const char* kChargeKey = "battery_remaining";

/// Calls a function for every number outside of lists; the function may change it.
class NumberVisitor final : public common::config::Fields {
 public:
  using Visit = std::function<void(const std::string& key, double& value, const Bounds& bounds, bool whole)>;
  explicit NumberVisitor(Visit visit) : visit_(std::move(visit)) {}

  using Fields::choice;
  void operator()(std::string_view name, double& value, const Bounds& bounds, std::string_view) override {
    visit_(prefix_ + std::string(name), value, bounds, false);
  }
  void operator()(std::string_view name, int& value, const Bounds& bounds, std::string_view) override {
    double number = value;
    visit_(prefix_ + std::string(name), number, bounds, true);
    value = static_cast<int>(number);
  }
  void operator()(std::string_view, bool&, std::string_view) override {}
  void operator()(std::string_view, std::string&, std::string_view) override {}
  void operator()(std::string_view, std::vector<double>&, const Bounds&, std::string_view) override {}
  void operator()(std::string_view, std::vector<std::string>&, std::string_view) override {}
  void choice(std::string_view, int&, const std::vector<std::string>&, std::string_view) override {}

 protected:
  bool beginSection(std::string_view name, std::string_view) override {
    lengths_.push_back(prefix_.size());
    prefix_ += std::string(name) + ".";
    return true;
  }
  void endSection(std::vector<std::string>) override {
    prefix_.resize(lengths_.back());
    lengths_.pop_back();
  }
  int beginList(std::string_view, int, std::string_view) override { return 0; }
  void beginItem(int) override {}
  void endList() override {}

 private:
  Visit visit_;
  std::string prefix_;                ///< Of the open sections: "sensors.imu.".
  std::vector<std::size_t> lengths_;  ///< Of the prefix before each open section.
};

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
