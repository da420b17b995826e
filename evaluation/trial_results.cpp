#include "evaluation/trial_results.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "evaluation/judge.hpp"

namespace swiftlet::evaluation {
namespace {

/// The number of the first score of each flight: vehicles that flew together follow each other with one seed.
std::vector<std::size_t> firstOfFlights(const std::vector<FlightScore>& scores) {
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < scores.size(); ++i)
    if (i == 0 || scores[i].vehicle.empty() || scores[i].seed != scores[i - 1].seed) first.push_back(i);
  return first;
}

template <typename Count>
int summed(const std::vector<FlightScore>& flights, Count count) {
  int sum = 0;
  for (const FlightScore& flight : flights) sum += count(flight);
  return sum;
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
  const auto median = [&](const char* what, std::optional<double> FlightScore::*member, double bound) {
    const int lacking = summed(flights, [&](const FlightScore& flight) { return flight.*member ? 0 : 1; });
    if (!flights.empty() && 2 * static_cast<std::size_t>(lacking) >= flights.size() && !std::isinf(bound))
      judge.fail(fmt::format("{}: {} of {} flights lack the figure, at most {:g} was asked for", what, lacking,
                             flights.size(), bound));
    else
      judge.atMost(what, medianOverAll(member, flights), bound);
  };
  median("goal error median, m", &FlightScore::goal_error_m, criteria.goal_error_median_max_m);
  median("home error median, m", &FlightScore::home_error_m, criteria.home_error_median_max_m);
  judge.atMost("mission time median, s", figure("mission_time_median_s"), criteria.mission_time_median_max_s);
  median("estimate RMS median, m", &FlightScore::estimate_rms_m, criteria.estimate_rms_median_max_m);
  median("map wall error median, m", &FlightScore::map_wall_error_median_m, criteria.map_wall_error_median_max_m);
  judge.atLeast("flights localized", figure("localized_flights"), criteria.localized_flights_min,
                "no flight was given a map");
  judge.atLeast("share of flights done", figure("done_share"), criteria.done_share_min);
  for (const PhaseBound& bound : figure_bounds)
    if (std::string failure = evaluation::missed(bound, figure(bound.figure)); !failure.empty())
      judge.fail(std::move(failure));
  if (criteria.verdicts) {
    judge.atMost("share of flights that landed or refused needlessly", figure("needless_share"),
                 criteria.needless_share_max);
    judge.atMost("crashes", count(Verdict::kCrashed), criteria.crashes_max);
  }
  return judge.failures;
}

bool TrialResult::met() const {
  const auto meets = [](const FlightScore& flight) { return flight.failures.empty(); };
  return !flights.empty() && std::all_of(flights.begin(), flights.end(), meets) && missed().empty();
}

int TrialResult::collisions() const {
  return summed(flights, [](const FlightScore& flight) { return flight.collisions; });
}
int TrialResult::glassContacts() const {
  return summed(flights, [](const FlightScore& flight) { return flight.glass_contacts; });
}
int TrialResult::count(Verdict verdict) const {
  return summed(flights, [&](const FlightScore& flight) { return flight.verdict == verdict ? 1 : 0; });
}

bool TrialResults::passed() const {
  return !trials.empty() && std::all_of(trials.begin(), trials.end(), [](const auto& trial) { return trial.met(); });
}

}  // namespace swiftlet::evaluation
