#include "evaluation/trial_results.hpp"

#include <algorithm>
#include <utility>

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
  std::vector<std::string> failures;
  const auto add = [&](std::string failure) {
    if (!failure.empty()) failures.push_back(std::move(failure));
  };
  const auto judge = [&](const TrialFigure& figure) { add(figure.failure(flights, criteria[figure.criterion.key])); };
  for (const TrialFigure* figure : judgedOverFlights()) judge(*figure);
  judge(trialFigure("done_share"));
  for (const PhaseBound& bound : figure_bounds) add(evaluation::missed(bound, figure(bound.figure)));
  if (criteria.verdicts) judge(trialFigure("needless_share"));
  return failures;
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
