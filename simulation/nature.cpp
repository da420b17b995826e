#include "simulation/nature.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "common/random.hpp"
#include "simulation/nature_ranges.hpp"
#include "simulation/quadrotor.hpp"

namespace swiftlet::simulation {
namespace {

/// One plant in twenty that can fly is found in all but one of 30,000 seeds: 0.95^200.
constexpr int kMostPlants = 200;

constexpr const char* kCharge = "battery_remaining";

bool flies(const Scenario& scenario, double thrust_over_weight) {
  return thrustOverWeight(scenario.vehicle, scenario.quadrotor, scenario.battery_remaining, Nature::kFullThrottle) >=
         thrust_over_weight;
}

/// Raises the charge until the thrust suffices; false if it does not at a full battery either.
bool chargeUntilItFlies(Scenario& scenario, double thrust_over_weight) {
  constexpr double kStep = 0.01;
  double& charge = scenario.battery_remaining;
  while (!flies(scenario, thrust_over_weight) && charge < 1.0) charge = std::min(1.0, charge + kStep);
  return flies(scenario, thrust_over_weight);
}

}  // namespace

Nature::Nature(std::string name, std::shared_ptr<const NatureRanges> ranges)
    : name_(std::move(name)), ranges_(std::move(ranges)) {}

Nature Nature::calm() { return {"calm", nullptr}; }

Nature Nature::load(const std::string& name) {
  if (name.empty())
    throw common::InputError({}, "nature", common::Message("nature.no-name", "has an empty name"),
                             "give calm, real, harsh, or a file");
  const std::filesystem::path file = NatureRanges::fileOf(name, {});
  Nature nature = fromText(NatureRanges::textOf(file), file.string());
  nature.name_ = std::filesystem::path(name).stem().string();
  return nature;
}

Nature Nature::fromText(const std::string& text, const std::string& name) {
  auto ranges = std::make_shared<const NatureRanges>(text, name);
  return {name, ranges->empty() ? nullptr : std::move(ranges)};
}

Nature Nature::withCharge(double low, double high) const {
  if (!ranges_) return *this;
  auto ranges = std::make_shared<NatureRanges>(*ranges_);
  ranges->narrow(kCharge, low, high);
  return {name_, std::move(ranges)};
}

std::optional<NatureRange> Nature::rangeOf(const std::string& key) const {
  return ranges_ ? ranges_->rangeOf(key) : std::nullopt;
}

Scenario Nature::drawn(const Scenario& scenario, std::uint64_t seed) const {
  if (!ranges_) return scenario;
  const std::vector<std::string>& written = scenario.written;
  const bool fixed_charge = std::find(written.begin(), written.end(), kCharge) != written.end();
  const bool draws_charge = !fixed_charge && ranges_->has(kCharge);
  const double least = ranges_->leastThrustOverWeight();
  std::optional<Scenario> first;
  for (std::uint64_t draw = 0; draw < kMostPlants; ++draw) {
    Scenario result = scenario;
    if (draws_charge) result.variation.battery_remaining = 0.0;
    ranges_->apply(result, written, [seed, draw](const std::string& key, double low, double high) {
      return common::RandomStream(seed, "nature " + key, draw).uniform(low, high);
    });
    if (fixed_charge ? flies(result, least) : chargeUntilItFlies(result, least)) return result;
    if (!first) first = std::move(result);
  }
  // The charge that is written out lifts no draw: what the vehicle does about it is then the subject of the trial.
  if (fixed_charge) return *first;
  throw common::InputError({ranges_->file()}, "least_thrust_over_weight",
                           common::Message("nature.too-heavy", "none of {} draws can lift the vehicle `{}`",
                                           kMostPlants, scenario.vehicle.name),
                           "draw a lighter vehicle, or more thrust");
}

std::string Nature::valuesIn(const Scenario& drawn) const { return ranges_ ? ranges_->valuesIn(drawn) : ""; }

}  // namespace swiftlet::simulation
