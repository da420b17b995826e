// What a trial asks of one of its systems alone.
#include "evaluation/system_bounds.hpp"

#include <gmock/gmock.h>

#include "common/config_check.hpp"
#include "evaluation/trial.hpp"
#include "evaluation/trial_results.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::evaluation {
namespace {

using test_support::HasProblem;
using testing::ElementsAre;
using testing::IsEmpty;

TrialConfig twoSystems() {
  TrialConfig trial;
  trial.name = "hover";
  trial.mission = "missions/a.xml";
  trial.scenario.world = "worlds/w.sdf";
  trial.systems = {"mit", "swiftlet"};
  trial.phases = {{.name = "hover",
                   .place_map_m = {0.0, 0.0},
                   .criteria = {{"position_rms_m", -PhaseBound{}.max, 0.06}, {"time_s", 50.0}}}};
  trial.asked_of = {{"swiftlet",
                     {{"estimate_rms_median_m", -PhaseBound{}.max, 0.01}},
                     {{"hover", {{"position_rms_m", -PhaseBound{}.max, 0.03}, {"speed_std_m_s", 0.0, 0.025}}}}}};
  return trial;
}

TEST(SystemBounds, TakeThePlaceOfThoseOfAllSystems) {
  EXPECT_THAT(common::config::problemsOf(twoSystems()), IsEmpty());
  const auto trials = twoSystems().byCondition();
  ASSERT_EQ(trials.size(), 2u);
  const auto& of_all = trials[0].phases.at(0).criteria;
  ASSERT_EQ(of_all.size(), 2u);
  EXPECT_EQ(of_all[0].max, 0.06);
  EXPECT_THAT(trials[0].figureBounds(), IsEmpty());
  const auto& ours = trials[1].phases.at(0).criteria;
  ASSERT_EQ(ours.size(), 3u);
  EXPECT_EQ(ours[0].figure, "position_rms_m");
  EXPECT_EQ(ours[0].max, 0.03);
  EXPECT_EQ(ours[2].figure, "speed_std_m_s");
  ASSERT_EQ(trials[1].figureBounds().size(), 1u);
}

TEST(SystemBounds, OfATrialWithOneSystemCountToo) {
  TrialConfig trial = twoSystems();
  trial.systems.clear();
  trial.system = "swiftlet";
  EXPECT_EQ(trial.byCondition().at(0).phases.at(0).criteria.at(0).max, 0.03);
}

TEST(SystemBounds, OfFiguresOverAllFlightsAreJudged) {
  TrialResult result{"hover", "swiftlet", {}, {}, {}, twoSystems().byCondition().at(1).figureBounds()};
  result.flights.resize(3);
  EXPECT_THAT(result.missed(), ElementsAre("estimate_rms_median_m: not measured, at most 0.01 was asked for"));
  for (FlightScore& flight : result.flights) flight["estimate_rms_m"] = 0.02;
  EXPECT_THAT(result.missed(), ElementsAre("estimate_rms_median_m: 0.0200, at most 0.01 was asked for"));
  for (FlightScore& flight : result.flights) flight["estimate_rms_m"] = 0.005;
  EXPECT_THAT(result.missed(), IsEmpty());
}

TEST(SystemBounds, OfWhatThereIsNotAreRefused) {
  TrialConfig trial = twoSystems();
  trial.asked_of[0].system = "dlr";
  trial.asked_of[0].phases[0].phase = "landing";
  trial.asked_of[0].figures[0].figure = "estimate_rms_m";
  TrialConfig other = twoSystems();
  other.asked_of[0].phases[0].criteria[0].figure = "position_rsm_m";
  EXPECT_THAT(common::config::problemsOf(other), HasProblem("phase.no-figure", "asked_of", "`position_rms_m`"));
  const auto problems = common::config::problemsOf(trial);
  EXPECT_THAT(problems, HasProblem("trial.no-system", "asked_of", "`dlr`"));
  EXPECT_THAT(problems, HasProblem("trial.no-phase", "asked_of", "`landing`"));
  EXPECT_THAT(problems, HasProblem("trial.no-figure", "asked_of[0].figures", "`estimate_rms_m`"));
}

}  // namespace
}  // namespace swiftlet::evaluation
