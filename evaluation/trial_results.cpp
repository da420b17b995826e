#include "evaluation/trial_results.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "evaluation/judge.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::evaluation {
namespace {

template <typename Value>
std::optional<double> valueOf(const FlightScore& flight, Value FlightScore::*member) {
  return flight.*member;
}
std::optional<double> valueOf(const FlightScore& flight, std::optional<double> ConductScore::*member) {
  return flight.conduct.*member;
}

/// The values of the flights that have the figure.
template <typename Member>
std::vector<double> figures(const std::vector<FlightScore>& flights, Member member) {
  std::vector<double> values;
  for (const FlightScore& flight : flights)
    if (const std::optional<double> value = valueOf(flight, member)) values.push_back(*value);
  return values;
}

template <typename Member>
std::optional<double> atQuantile(const std::vector<FlightScore>& flights, Member member, double q) {
  const std::vector<double> values = figures(flights, member);
  if (values.empty()) return std::nullopt;
  return quantile(values, q);
}

/// The number of the first score of each flight: vehicles that flew together follow each other with one seed.
std::vector<std::size_t> firstOfFlights(const std::vector<FlightScore>& scores) {
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < scores.size(); ++i)
    if (i == 0 || scores[i].vehicle.empty() || scores[i].seed != scores[i - 1].seed) first.push_back(i);
  return first;
}

/// A flight that lacks the figure counts as worse than any that has it.
std::optional<double> medianOverAll(const std::vector<FlightScore>& flights,
                                    std::optional<double> FlightScore::*member) {
  if (flights.empty()) return std::nullopt;
  std::vector<double> values;
  for (const FlightScore& flight : flights)
    values.push_back((flight.*member).value_or(std::numeric_limits<double>::max()));
  return quantile(values, 0.5);
}

constexpr double kMin = 0.0, kMedian = 0.5, kMax = 1.0;

std::optional<double> localizationPathLength_m(const std::vector<FlightScore>& flights, double q) {
  std::vector<double> path_lengths_m;
  for (const FlightScore& flight : flights)
    if (flight.localization && flight.localization->path_length_m)
      path_lengths_m.push_back(*flight.localization->path_length_m);
  if (path_lengths_m.empty()) return std::nullopt;
  return quantile(path_lengths_m, q);
}

}  // namespace

int TrialResult::flown() const { return static_cast<int>(firstOfFlights(flights).size()); }

int TrialResult::passed() const {
  const std::vector<std::size_t> first = firstOfFlights(flights);
  int passed = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto begin = flights.begin() + static_cast<std::ptrdiff_t>(first[i]);
    const auto end = i + 1 < first.size() ? flights.begin() + static_cast<std::ptrdiff_t>(first[i + 1]) : flights.end();
    passed += std::all_of(begin, end, [](const FlightScore& score) { return score.passed(); }) ? 1 : 0;
  }
  return passed;
}

std::vector<std::string> TrialResult::missed() const {
  Judge judge;
  const auto median = [&](const char* figure, std::optional<double> FlightScore::*member, double bound) {
    const std::size_t lacking = flights.size() - figures(flights, member).size();
    if (!flights.empty() && 2 * lacking >= flights.size() && !std::isinf(bound))
      judge.fail(fmt::format("{}: {} of {} flights lack the figure, at most {:g} was asked for", figure, lacking,
                             flights.size(), bound));
    else
      judge.atMost(figure, medianOverAll(flights, member), bound);
  };
  median("goal error median, m", &FlightScore::goal_error_m, criteria.goal_error_median_max_m);
  median("home error median, m", &FlightScore::home_error_m, criteria.home_error_median_max_m);
  judge.atMost("mission time median, s", missionTimeMedian_s(), criteria.mission_time_median_max_s);
  median("estimate RMS median, m", &FlightScore::estimate_rms_m, criteria.estimate_rms_median_max_m);
  median("map wall error median, m", &FlightScore::map_wall_error_median_m, criteria.map_wall_error_median_max_m);
  judge.atLeast("flights localized", localizedFlights(), criteria.localized_flights_min, "no flight was given a map");
  return judge.failures;
}

bool TrialResult::met() const { return !flights.empty() && passed() == flown() && missed().empty(); }

int TrialResult::collisions() const {
  int sum = 0;
  for (const FlightScore& flight : flights) sum += flight.collisions;
  return sum;
}

std::optional<double> TrialResult::coverageMin() const { return atQuantile(flights, &FlightScore::coverage, kMin); }
std::optional<double> TrialResult::goalErrorMax_m() const {
  return atQuantile(flights, &FlightScore::goal_error_m, kMax);
}
std::optional<double> TrialResult::goalErrorMedian_m() const {
  return atQuantile(flights, &FlightScore::goal_error_m, kMedian);
}
std::optional<double> TrialResult::homeErrorMax_m() const {
  return atQuantile(flights, &FlightScore::home_error_m, kMax);
}
std::optional<double> TrialResult::homeErrorMedian_m() const {
  return atQuantile(flights, &FlightScore::home_error_m, kMedian);
}
std::optional<double> TrialResult::markerErrorMax_m() const {
  return atQuantile(flights, &FlightScore::marker_error_m, kMax);
}
std::optional<double> TrialResult::markerErrorMedian_m() const {
  return atQuantile(flights, &FlightScore::marker_error_m, kMedian);
}
std::optional<double> TrialResult::relocalizationErrorMax_m() const {
  return atQuantile(flights, &FlightScore::relocalization_error_m, kMax);
}
std::optional<double> TrialResult::relocalizationErrorMedian_m() const {
  return atQuantile(flights, &FlightScore::relocalization_error_m, kMedian);
}
std::optional<double> TrialResult::missionTimeMedian_s() const {
  std::vector<FlightScore> done;
  std::copy_if(flights.begin(), flights.end(), std::back_inserter(done), [](const auto& f) { return f.mission_done; });
  return atQuantile(done, &FlightScore::mission_time_s, kMedian);
}
std::optional<double> TrialResult::estimateRmsMedian_m() const {
  return atQuantile(flights, &FlightScore::estimate_rms_m, kMedian);
}
std::optional<double> TrialResult::mapWallErrorMedian_m() const {
  return atQuantile(flights, &FlightScore::map_wall_error_median_m, kMedian);
}
std::optional<double> TrialResult::realtimeFactorMedian() const {
  return atQuantile(flights, &FlightScore::realtime_factor, kMedian);
}

std::optional<double> TrialResult::localizedFlights() const {
  int given = 0, in_time = 0;
  for (const FlightScore& flight : flights) {
    given += flight.localization ? 1 : 0;
    in_time += flight.localization && flight.localization->in_time ? 1 : 0;
  }
  if (given == 0) return std::nullopt;
  return static_cast<double>(in_time) / given;
}
std::optional<double> TrialResult::localizationPathLengthMedian_m() const {
  return localizationPathLength_m(flights, kMedian);
}
std::optional<double> TrialResult::localizationPathLengthMax_m() const {
  return localizationPathLength_m(flights, kMax);
}
std::optional<double> TrialResult::wrongTimeShareMax() const {
  std::optional<double> greatest;
  for (const FlightScore& flight : flights)
    if (flight.localization) greatest = std::max(flight.localization->wrong_share, greatest.value_or(0.0));
  return greatest;
}

std::optional<double> TrialResult::tiltedShareMax() const {
  return atQuantile(flights, &ConductScore::tilted_share, kMax);
}
std::optional<double> TrialResult::thrustMarginMin() const {
  return atQuantile(flights, &ConductScore::thrust_margin_min, kMin);
}
std::optional<double> TrialResult::touchDownSpeedMax_m_s() const {
  return atQuantile(flights, &ConductScore::touch_down_speed_m_s, kMax);
}
std::optional<double> TrialResult::safeActionMax_s() const {
  return atQuantile(flights, &ConductScore::safe_action_s, kMax);
}
std::optional<double> TrialResult::homeEnergyErrorMax() const {
  return atQuantile(flights, &ConductScore::home_energy_error, kMax);
}

std::optional<double> TrialResult::goalErrorMaxRaw_m() const {
  return atQuantile(flights, &FlightScore::goal_error_raw_m, kMax);
}
std::optional<double> TrialResult::goalErrorMedianRaw_m() const {
  return atQuantile(flights, &FlightScore::goal_error_raw_m, kMedian);
}
std::optional<double> TrialResult::homeErrorMaxRaw_m() const {
  return atQuantile(flights, &FlightScore::home_error_raw_m, kMax);
}
std::optional<double> TrialResult::homeErrorMedianRaw_m() const {
  return atQuantile(flights, &FlightScore::home_error_raw_m, kMedian);
}
std::optional<double> TrialResult::estimateRmsMedianRaw_m() const {
  return atQuantile(flights, &FlightScore::estimate_rms_raw_m, kMedian);
}
std::optional<double> TrialResult::mapWallErrorMedianRaw_m() const {
  return atQuantile(flights, &FlightScore::map_wall_error_median_raw_m, kMedian);
}

bool TrialResults::passed() const {
  return !trials.empty() && std::all_of(trials.begin(), trials.end(), [](const auto& trial) { return trial.met(); });
}

}  // namespace swiftlet::evaluation
