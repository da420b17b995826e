#include "evaluation/envelope_results.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

namespace swiftlet::evaluation {
namespace {

using simulation::Nature;

/// How a key that ends like this is shown.
struct ShownUnit {
  std::string_view ending;
  double factor;
  const char* unit;
};

constexpr ShownUnit kShownUnits[] = {{"_m_s2", 1, " m/s2"},   {"_m_s", 1, " m/s"},    {"_rad_s", 1, " rad/s"},
                                     {"_deg_s", 1, " deg/s"}, {"_1_s2", 1, " 1/s2"},  {"_1_s", 1, " 1/s"},
                                     {"_s", 1e3, " ms"},      {"_ohm", 1e3, " mohm"}, {"_deg", 1, " deg"},
                                     {"_ppm", 1, " ppm"},     {"_m", 1, " m"},        {"_share", 100, " %"},
                                     {"_rate", 100, " %"},    {"_error", 100, " %"},  {"_remaining", 100, " %"}};

/// Smaller is nearer to failing.
std::tuple<int, double> reserveOf(const EnvelopeEntry& entry) {
  const EnvelopeFinding& finding = entry.finding;
  const EnvelopeStep* failing = finding.firstFailing();
  const double value = failing != nullptr ? failing->value : finding.acceptableTo().value_or(finding.from);
  const auto multiple = entry.harshMultiple(value);
  return {failing != nullptr ? (multiple ? 0 : 1) : 2, multiple.value_or(finding.share(value))};
}

}  // namespace

std::optional<double> EnvelopeEntry::worstOf(const std::optional<simulation::NatureRange>& nature) const {
  if (!nature) return std::nullopt;
  const double worst = finding.quantity.to > finding.from ? nature->high : nature->low;
  return finding.share(worst) > 0.0 ? std::optional(worst) : std::nullopt;
}

std::optional<double> EnvelopeEntry::harshMultiple(double value) const {
  const auto worst = worstOf(harsh);
  return worst ? std::optional((value - finding.from) / (*worst - finding.from)) : std::nullopt;
}

bool EnvelopeResults::complete() const {
  return base.acceptable() &&
         std::all_of(entries.begin(), entries.end(), [](const auto& entry) { return entry.finding.complete; });
}

int EnvelopeResults::flights() const {
  std::size_t count = base.flights.size();
  for (const EnvelopeEntry& entry : entries)
    for (std::size_t i = 1; i < entry.finding.steps.size(); ++i) count += entry.finding.steps[i].flights.size();
  return static_cast<int>(count);
}

std::vector<const EnvelopeEntry*> EnvelopeResults::byReserve() const {
  std::vector<const EnvelopeEntry*> sorted;
  for (const EnvelopeEntry& entry : entries) sorted.push_back(&entry);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto* a, const auto* b) { return reserveOf(*a) < reserveOf(*b); });
  return sorted;
}

std::string shownValue(const std::string& key, double value) {
  for (const ShownUnit& one : kShownUnits)
    if (key.ends_with(one.ending)) return fmt::format("{:.3g}{}", one.factor * value, one.unit);
  return fmt::format("{:.3g}", value);
}

std::string endingText(const EnvelopeFinding& finding) {
  const EnvelopeStep* failing = finding.firstFailing();
  if (failing == nullptr) {
    std::size_t flown = 0;
    for (const EnvelopeStep& step : finding.steps) flown += step.flights.size();
    return fmt::format("none of {} failed", flown);
  }
  const EnvelopeFlight& flight = failing->flights.back();
  const std::string ending = flight.ending == flight.verdict ? "" : ": " + flight.ending;
  return fmt::format("{}{} (seed {})", flight.verdict, ending, flight.seed);
}

}  // namespace swiftlet::evaluation
