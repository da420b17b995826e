#include "evaluation/trial_results.hpp"

#include <algorithm>
#include <iterator>

#include "evaluation/judge.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::evaluation {
namespace {

/// The values of the flights that have the figure.
template <typename Member>
std::vector<double> figures(const std::vector<FlightScore>& flights, Member member) {
  std::vector<double> values;
  for (const FlightScore& flight : flights)
    if (const std::optional<double> value = flight.*member) values.push_back(*value);
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
  judge.atMost("goal error median, m", goalErrorMedian_m(), criteria.goal_error_median_max_m);
  judge.atMost("home error median, m", homeErrorMedian_m(), criteria.home_error_median_max_m);
  judge.atMost("mission time median, s", missionTimeMedian_s(), criteria.mission_time_median_max_s);
  judge.atMost("estimate RMS median, m", estimateRmsMedian_m(), criteria.estimate_rms_median_max_m);
  judge.atMost("map wall error median, m", mapWallErrorMedian_m(), criteria.map_wall_error_median_max_m);
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

bool TrialResults::passed() const {
  return !trials.empty() && std::all_of(trials.begin(), trials.end(), [](const auto& trial) { return trial.met(); });
}

}  // namespace swiftlet::evaluation
