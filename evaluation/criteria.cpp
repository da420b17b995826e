// The criteria of a trial: what they are in its file, and which a flight misses.
#include "evaluation/criteria.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/check.hpp"
#include "common/config_fields.hpp"
#include "evaluation/flight_score.hpp"

namespace swiftlet::evaluation {
namespace {

using enum FigureGroup;

/// The groups of figures in the order of their criteria: what a mission must reach, and what every flight must.
constexpr std::initializer_list<FigureGroup> kOfMissions = {kCoverage, kGoals, kMission,
                                                            kEstimate, kMap3d, kLocalization};
constexpr std::initializer_list<FigureGroup> kOfFlights = {kConduct, kHomeEnergy, kBehaviors,
                                                           kCourse,  kDistance,   kMachine};

bool isOf(const Criterion& criterion, std::string_view key) { return criterion.key != nullptr && criterion.key == key; }

const Criterion& criterionOf(std::string_view key) {
  const Criterion* found = nullptr;
  for (const FlightFigure& figure : flightFigures()) {
    if (isOf(figure.criterion, key)) found = &figure.criterion;
    for (const TrialFigure& over_flights : figure.over_flights)
      if (isOf(over_flights.criterion, key)) found = &over_flights.criterion;
  }
  SWIFTLET_CHECK(found != nullptr, key);
  return *found;
}

bool isAsked(const Criterion& criterion, const Criteria& criteria, const FlightScore& flight, bool measured) {
  const bool of_mission = flight.mission_done || !criteria.verdicts;
  switch (criterion.asked) {
    case Criterion::Asked::kOfMission:
      return of_mission;
    case Criterion::Asked::kIfMeasured:
      return of_mission || measured;
    case Criterion::Asked::kOfMeasured:
      return measured;
    case Criterion::Asked::kAlways:
      return true;
    case Criterion::Asked::kOfUndone:
      return !flight.mission_done;
  }
  return true;
}

void judgeFigures(std::initializer_list<FigureGroup> groups, const FlightScore& flight, const Criteria& criteria,
                  std::vector<std::string>& failures) {
  for (const FlightFigure* figure : figuresOf(groups)) {
    const Criterion& criterion = figure->criterion;
    const std::optional<double> value = flight.figure(figure->name);
    if (criterion.key == nullptr || !isAsked(criterion, criteria, flight, value.has_value())) continue;
    const std::string& problem = figure->group == kCoverage ? flight.coverage_problem : std::string();
    std::string failure = criterion.failure(value, criteria[criterion.key], problem);
    if (!failure.empty()) failures.push_back(std::move(failure));
  }
}

/// The end of the flight. Needless landings are judged over all flights, see TrialResult::missed().
void judgeEnding(const FlightScore& flight, const Criteria& criteria, std::vector<std::string>& failures) {
  if (criteria.mission_done && !flight.mission_done) failures.push_back("mission: " + flight.outcome);
  if (flight.avoidable_collisions > criteria.collisions_max) failures.push_back(flight.collisionText());
  if (criteria.verdicts && (flight.verdict == Verdict::kOutside || flight.verdict == Verdict::kUnfinished))
    failures.push_back(fmt::format("verdict {}: {}", toString(flight.verdict), flight.verdict_reason));
}

/// Criteria of single steps apply to every flight, however it ended.
void judgeSteps(const FlightScore& flight, std::vector<std::string>& failures) {
  for (const PhaseScore& phase : flight.phases)
    for (std::string& failure : phase.missed()) failures.push_back(std::move(failure));
  for (const EventOrderScore& order : flight.event_orders)
    for (std::string& failure : order.missed()) failures.push_back("order of events: " + failure);
  for (const OperatorAnswer& answer : flight.operator_answers)
    if (std::string failure = answer.failure(); !failure.empty()) failures.push_back(std::move(failure));
}

}  // namespace

double& Criteria::operator[](std::string_view key) {
  return bounds_.try_emplace(std::string(key), criterionOf(key).unasked()).first->second;
}

double Criteria::operator[](std::string_view key) const {
  const auto bound = bounds_.find(key);
  return bound == bounds_.end() ? criterionOf(key).unasked() : bound->second;
}

bool Criteria::asksFor(std::string_view figure) const {
  const Criterion& criterion = flightFigure(figure).criterion;
  return criterion.key != nullptr && criterion.asks((*this)[criterion.key]);
}

void Criteria::describe(common::config::Fields& fields) {
  const auto describeBound = [&](const Criterion& criterion) {
    if (criterion.key != nullptr) fields(criterion.key, (*this)[criterion.key], criterion.values, criterion.sentence);
  };
  const auto describeEach = [&](FigureGroup group) {
    for (const FlightFigure* figure : figuresOf({group})) describeBound(figure->criterion);
  };
  fields("mission_done", mission_done, "Whether the mission must end well.");
  fields(
      "collisions_max", collisions_max, {0, 0},
      "Greatest number of contacts in a flight, but forced ones. It is always 0: no trial passes with such a contact.");
  fields(
      "verdicts", verdicts,
      "Whether a flight that did not do its mission is judged by the truth: it passes if it came home, landed inside, "
      "or refused to take off. Figures of the mission are then asked only of flights that did it.");
  describeBound(trialFigure("needless_share").criterion);
  describeBound(trialFigure("done_share").criterion);
  for (const FigureGroup group : kOfMissions) {
    if (group == kLocalization)
      fields("localized_within_m", localized_within_m, common::config::kPositive,
             "Path length within which a flight that is given a map must have found itself in it to count as "
             "localized.");
    describeEach(group);
  }
  for (const FigureGroup group : kOfFlights) describeEach(group);
  fields("all_resumed", all_resumed, "Whether everything that was interrupted must have gone on.");
  for (const TrialFigure* figure : judgedOverFlights()) describeBound(figure->criterion);
}

std::vector<const TrialFigure*> judgedOverFlights() {
  std::vector<const TrialFigure*> judged;
  for (const FlightFigure* figure : figuresOf(kOfMissions))
    for (const TrialFigure& over_flights : figure->over_flights)
      if (over_flights.criterion.key != nullptr) judged.push_back(&over_flights);
  return judged;
}

std::vector<std::string> missed(const FlightScore& flight, const Criteria& criteria) {
  std::vector<std::string> failures;
  judgeEnding(flight, criteria, failures);
  judgeFigures(kOfMissions, flight, criteria, failures);
  if (criteria.all_resumed && (flight.mission_done || !criteria.verdicts) && flight.resumed < flight.interruptions)
    failures.push_back(fmt::format("interruptions: {} of {} went on", flight.resumed, flight.interruptions));
  judgeFigures(kOfFlights, flight, criteria, failures);
  judgeSteps(flight, failures);
  return failures;
}

}  // namespace swiftlet::evaluation
