// The table of figures: every row is whole, and its criterion judges.
#include "evaluation/figures.hpp"
#include "evaluation/criteria.hpp"

#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "evaluation/trial_results.hpp"

namespace swiftlet::evaluation {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

std::string name(const char* text) { return text == nullptr ? "" : text; }

TEST(FigureTable, HasEachNameOnce) {
  std::set<std::string> names, names_over_flights, keys = {""};
  for (const FlightFigure& figure : flightFigures()) {
    EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
    EXPECT_TRUE(figure.criterion.key == nullptr || keys.insert(figure.criterion.key).second) << figure.criterion.key;
    for (const TrialFigure& over_flights : figure.over_flights) {
      EXPECT_TRUE(names_over_flights.insert(over_flights.name).second) << over_flights.name;
      const std::string key = name(over_flights.criterion.key);
      EXPECT_TRUE(key.empty() || keys.insert(key).second) << key;
    }
  }
  EXPECT_FALSE(trialFigureProblem("goal_error_max_m"));
  EXPECT_THAT(trialFigureProblem("goal_eror_max_m")->hint, testing::HasSubstr("goal_error_max_m"));
}

/// A figure of the flight that misses a bound of 1, and one that holds it.
TEST(FigureTable, EachCriterionOfAFlightFailsWhatMissesItAndWhatLacksIt) {
  for (const FlightFigure& figure : flightFigures()) {
    const Criterion& criterion = figure.criterion;
    if (criterion.key == nullptr || figure.of != nullptr) continue;
    const bool at_most = criterion.bound == Criterion::Bound::kAtMost;
    Criteria criteria;
    criteria.mission_done = false;
    FlightScore flight;
    flight.mission_done = criterion.asked != Criterion::Asked::kOfUndone;
    EXPECT_THAT(missed(flight, criteria), IsEmpty()) << figure.name << " is not asked for";
    criteria[criterion.key] = 1.0;
    if (criterion.asked == Criterion::Asked::kOfMeasured)
      EXPECT_THAT(missed(flight, criteria), IsEmpty()) << figure.name << " is asked for where it was measured";
    else
      EXPECT_THAT(missed(flight, criteria), ElementsAre(StartsWith(name(criterion.label) + ": not measured")));
    flight[figure.name] = at_most ? 2.0 : 0.5;
    EXPECT_THAT(missed(flight, criteria), ElementsAre(StartsWith(name(criterion.label) + (at_most ? ": 2" : ": 0.5"))));
    flight[figure.name] = 1.0;
    EXPECT_THAT(missed(flight, criteria), IsEmpty()) << "bounds are inclusive";
  }
}

TEST(FigureTable, EachFigureIsInTheResultsOfItsFlight) {
  TrialResult trial{"lab", "swiftlet", {}, {}};
  FlightScore& flight = trial.flights.emplace_back();
  for (const FlightFigure& figure : flightFigures())
    if (figure.of == nullptr) flight[figure.name] = 0.125;
  flight.machine = {0.125, 0.125, 0.125, 0.125, 0.125};
  const auto json = nlohmann::json::parse(toJson({{trial}}))["trials"][0];
  const std::string text = json["flights"][0].dump();
  for (const FlightFigure& figure : flightFigures()) {
    const std::string key = figure.key != nullptr ? figure.key : figure.name;
    const bool written = figure.in_results != FlightFigure::InResults::kNot && figure.group != FigureGroup::kVerdict;
    EXPECT_EQ(text.find("\"" + key + "\":") != std::string::npos, written) << figure.name;
    for (const TrialFigure& over_flights : figure.over_flights) EXPECT_TRUE(json.contains(over_flights.name));
  }
}

}  // namespace
}  // namespace swiftlet::evaluation
