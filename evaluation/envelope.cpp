#include "evaluation/envelope.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/config.hpp"
#include "common/config_fields.hpp"
#include "common/error.hpp"
#include "common/validation.hpp"
#include "simulation/plant_keys.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Message;
using simulation::PlantKey;
using simulation::Scenario;

std::vector<std::string> keysWithFractions() {
  std::vector<std::string> keys;
  for (const PlantKey& one : simulation::plantKeys(Scenario()))
    if (!one.whole) keys.push_back(one.key);
  return keys;
}

}  // namespace

void EnvelopeQuantity::describe(common::config::Fields& fields) {
  fields("key", key, "A number of the scenario's plant: battery_remaining, quadrotor.motor_lag_s.");
  fields("to", to, common::config::kFinite,
         "Value up to which the quantity is turned from that of the base; it must be given, and may be the lower one.");
  fields("name", name, "Name of the quantity, for people; the key if none is given.");
}

std::vector<common::Problem> EnvelopeQuantity::validate() const {
  common::Validation validation;
  const auto found = simulation::plantKey(Scenario(), key);
  if (key.empty()) return validation.given(false, "key").problems();
  if (!found)
    return validation
        .require(false, "key", Message("envelope.no-number", "the plant has no number `{}`", key),
                 common::didYouMean(key, keysWithFractions()))
        .problems();
  return validation
      .require(!found->whole, "key",
               Message("envelope.counts", "`{}` counts, and cannot be turned up by fractions", key))
      .require(std::isnan(to) || found->bounds.contain(to), "to",
               found->bounds.problem(to) += fmt::format(", the bounds of `{}`", key))
      .problems();
}

void EnvelopeConfig::describe(common::config::Fields& fields) {
  fields("base", base, "Nature in which all other quantities stay; it draws none that is turned up.");
  fields("seeds", seeds, {1, 1000}, "Flights at each value, seeds S, S+1, ... of the trial.");
  fields("steps", steps, {1, 100}, "Values at equal distances over the range of a quantity; the base is not counted.");
  fields("bisections", bisections, {0, 20},
         "Further values between the last that was acceptable and the first that failed.");
  fields.list("quantities", quantities, "What is turned up, each alone.");
}

std::vector<common::Problem> EnvelopeConfig::validate() const {
  common::Validation validation;
  validation.require(!quantities.empty(), "quantities",
                     Message("envelope.nothing", "are missing: there is nothing to turn up"));
  for (auto one = quantities.begin(); one != quantities.end(); ++one)
    validation.require(std::none_of(quantities.begin(), one,
                                    [&](const auto& other) { return other.key == one->key && other.to == one->to; }),
                       "quantities", Message("envelope.twice", "`{}` to {:g} is listed twice", one->key, one->to));
  return validation.problems();
}

EnvelopeConfig readEnvelope(const std::filesystem::path& file) {
  EnvelopeConfig config = common::config::readFile<EnvelopeConfig>(file.string());
  for (EnvelopeQuantity& quantity : config.quantities)
    if (quantity.name.empty()) quantity.name = quantity.key;
  return config;
}

Scenario pinned(const Scenario& scenario, const simulation::Nature& base) {
  Scenario result = scenario;
  result.variation.battery_remaining = 0.0;
  result.variation.wind_m_s = 0.0;
  std::erase(result.written, "variation.battery_remaining");
  result.nature = std::make_shared<const simulation::Nature>(base);
  const auto written = std::find(result.written.begin(), result.written.end(), "battery_remaining");
  const auto charge = base.rangeOf("battery_remaining");
  result.setCharge(written == result.written.end() && charge ? charge->high : result.battery_remaining);
  return result;
}

double baseValue(const EnvelopeQuantity& quantity, const Scenario& pinned) {
  const simulation::Nature& base = *pinned.nature;
  const auto wrong = [&](Message what) { return common::InputError({base.name()}, quantity.key, std::move(what)); };
  const auto range = base.rangeOf(quantity.key);
  const bool is_charge = quantity.key == "battery_remaining";  // pinned() has fixed it.
  if (range && range->low < range->high && !is_charge)
    throw wrong(Message("envelope.drawn", "is drawn from {:g} to {:g} by the base, and cannot be turned up from there",
                        range->low, range->high));
  const double value = simulation::plantKey(base.drawn(pinned, 0), quantity.key)->value;
  if (value == quantity.to)
    throw wrong(
        Message("envelope.there-already", "is {:g} in the base already, where it was to be turned up to", value));
  return value;
}

EnvelopeFlight envelopeFlight(const std::vector<FlightScore>& scores) {
  EnvelopeFlight flight;
  flight.acceptable = true;
  for (const FlightScore& score : scores) {
    if (!flight.acceptable) break;
    flight.seed = score.seed;
    flight.goal_error_m = score.figure("goal_error_m");
    flight.folder = score.folder;
    flight.ending = score.verdict_reason.empty() ? score.outcome : score.verdict_reason;
    flight.acceptable = evaluation::acceptable(score.verdict);
    flight.verdict = toString(score.verdict);
  }
  return flight;
}

bool EnvelopeStep::acceptable() const {
  return !flights.empty() &&
         std::all_of(flights.begin(), flights.end(), [](const auto& one) { return one.acceptable; });
}

void EnvelopeFinding::add(EnvelopeStep step) {
  const auto behind = std::upper_bound(steps.begin(), steps.end(), step, [this](const auto& a, const auto& b) {
    return share(a.value) < share(b.value);
  });
  steps.insert(behind, std::move(step));
}

const EnvelopeStep* EnvelopeFinding::firstFailing() const {
  const auto found = std::find_if(steps.begin(), steps.end(), [](const auto& step) { return !step.acceptable(); });
  return found == steps.end() ? nullptr : &*found;
}

std::optional<double> EnvelopeFinding::acceptableTo() const {
  std::optional<double> value;
  for (const EnvelopeStep& step : steps) {
    if (!step.acceptable()) break;
    value = step.value;
  }
  return value;
}

std::vector<double> EnvelopeFinding::acceptableBeyond() const {
  std::vector<double> values;
  const EnvelopeStep* failing = firstFailing();
  for (const EnvelopeStep& step : steps)
    if (failing != nullptr && share(step.value) > share(failing->value) && step.acceptable())
      values.push_back(step.value);
  return values;
}

std::optional<double> nextValue(const EnvelopeFinding& finding, const EnvelopeConfig& config) {
  const double from = finding.from, to = finding.quantity.to;
  if (!finding.acceptableTo()) return std::nullopt;
  for (int i = 1; i <= config.steps; ++i) {
    const double value = i == config.steps ? to : from + (to - from) * i / config.steps;
    const bool flown = std::any_of(finding.steps.begin(), finding.steps.end(),
                                   [value](const EnvelopeStep& step) { return step.value == value; });
    if (!flown) return value;
  }
  const EnvelopeStep* failing = finding.firstFailing();
  const int bisected = static_cast<int>(finding.steps.size()) - 1 - config.steps;
  if (failing == nullptr || bisected >= config.bisections) return std::nullopt;
  return 0.5 * (*finding.acceptableTo() + failing->value);
}

}  // namespace swiftlet::evaluation
