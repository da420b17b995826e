// Writes envelope.json.
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/rounding.hpp"
#include "evaluation/envelope_results.hpp"

namespace swiftlet::evaluation {
namespace {

using Json = nlohmann::ordered_json;

/// Six significant digits: values of natures go from parts of a millisecond to hundreds.
double figure(double value) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  return common::rounded(value, 5 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
}

Json figureOrNull(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(figure(*value)) : Json(nullptr);
}

Json rangeJson(const std::optional<simulation::NatureRange>& range) {
  return range ? Json{figure(range->low), figure(range->high)} : Json(nullptr);
}

Json stepJson(const EnvelopeStep& step) {
  Json flights = Json::array();
  for (const EnvelopeFlight& flight : step.flights)
    flights.push_back({{"seed", flight.seed},
                       {"acceptable", flight.acceptable},
                       {"verdict", flight.verdict},
                       {"ending", flight.ending},
                       {"goal_error_m", figureOrNull(flight.goal_error_m)},
                       {"folder", flight.folder}});
  return {{"value", figure(step.value)}, {"acceptable", step.acceptable()}, {"flights", flights}};
}

Json entryJson(const EnvelopeEntry& entry) {
  const EnvelopeFinding& finding = entry.finding;
  const EnvelopeStep* failing = finding.firstFailing();
  Json beyond = Json::array(), steps = Json::array();
  for (const double value : finding.acceptableBeyond()) beyond.push_back(figure(value));
  for (const EnvelopeStep& step : finding.steps) steps.push_back(stepJson(step));
  return {{"name", finding.quantity.name},
          {"key", finding.quantity.key},
          {"base", figure(finding.from)},
          {"to", figure(finding.quantity.to)},
          {"complete", finding.complete},
          {"acceptable_to", figureOrNull(finding.acceptableTo())},
          {"fails_at", failing != nullptr ? Json(figure(failing->value)) : Json(nullptr)},
          {"acceptable_beyond", beyond},
          {"real", rangeJson(entry.real)},
          {"harsh", rangeJson(entry.harsh)},
          {"multiple_of_harsh", failing != nullptr ? figureOrNull(entry.harshMultiple(failing->value)) : Json(nullptr)},
          {"steps", steps}};
}

}  // namespace

std::string toJson(const EnvelopeResults& results) {
  Json quantities = Json::array();
  for (const EnvelopeEntry& entry : results.entries) quantities.push_back(entryJson(entry));
  const Json json = {
      {"envelope", results.trial},     {"version", results.version},     {"system", results.system},
      {"mission", results.mission},    {"base", results.config.base},    {"first_seed", results.first_seed},
      {"seeds", results.config.seeds}, {"steps", results.config.steps},  {"bisections", results.config.bisections},
      {"flights", results.flights()},  {"complete", results.complete()}, {"base_flights", stepJson(results.base)},
      {"quantities", quantities}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace swiftlet::evaluation
