// The gains of a controller as numbers, and the search for better ones.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/gains.hpp"
#include "control/identification/gain_search.hpp"

namespace swiftlet::control {
namespace {

std::vector<std::string> namesOf(const std::vector<Gain>& gains) {
  std::vector<std::string> names;
  for (const Gain& gain : gains) names.push_back(gain.name);
  return names;
}

TEST(Gains, AreThoseOfTheControllerThatFlies) {
  FlightController::Config config;
  config.controller.kind = ControllerKind::kCascadedPid;
  config.controller.cascaded_pid.horizontal_i_1_s3 = 0.0;
  EXPECT_THAT(namesOf(gainsOf(config)), testing::ElementsAre("horizontal_p_1_s2", "horizontal_d_1_s", "vertical_p_1_s2",
                                                             "vertical_i_1_s3", "vertical_d_1_s", "yaw_p_1_s"));
  for (const ControllerKind kind :
       {ControllerKind::kSwiftlet, ControllerKind::kVoltagePid, ControllerKind::kLqr, ControllerKind::kSlidingMode}) {
    config.controller.kind = kind;
    EXPECT_GE(gainsOf(config).size(), 5u) << toString(kind);
  }
  EXPECT_EQ(sectionOfGains(ControllerKind::kLqr), "controller.lqr");
}

TEST(Gains, AreSetByTheirNames) {
  FlightController::Config config;
  config.controller.kind = ControllerKind::kVoltagePid;
  const auto changed = withGains(config, {{"vertical_d_s_m", 0.5, {0, 10}}, {"yaw_p_1_s", 3.0, {0, 10}}});
  EXPECT_EQ(changed.controller.voltage_pid.vertical_d_s_m, 0.5);
  EXPECT_EQ(changed.controller.voltage_pid.yaw_p_1_s, 3.0);
  EXPECT_EQ(changed.controller.voltage_pid.vertical_p_1_m, config.controller.voltage_pid.vertical_p_1_m);
}

/// The cost of a valley along the diagonal, at its least where both gains are `best`.
double valley(const std::vector<Gain>& gains, double best) {
  const double a = std::log(gains[0].value / best), b = std::log(gains[1].value / best);
  return 1.0 + a * a + b * b + 1.2 * a * b;
}

TEST(GainSearch, FindsTheLeastCostAndCountsWhatItFlew) {
  const std::vector<Gain> start = {{"p", 1.0, {0, 40}}, {"d", 1.0, {0, 40}}};
  int flown = 0;
  const auto cost = [&](const std::vector<Gain>& gains) {
    ++flown;
    return valley(gains, 3.0);
  };
  const GainSearch search = searchGains(start, {60, 1.5, 6.0}, cost);
  EXPECT_EQ(search.evaluations, flown);
  EXPECT_LE(flown, 60);
  EXPECT_NEAR(search.gains[0].value, 3.0, 0.3);
  EXPECT_NEAR(search.gains[1].value, 3.0, 0.3);
  EXPECT_NEAR(search.before, valley(start, 3.0), 1e-12);
  EXPECT_LT(search.after, 1.01);
}

TEST(GainSearch, NeverSpendsMoreNorReturnsWorse) {
  const std::vector<Gain> start = {{"p", 1.0, {0, 40}}, {"d", 1.0, {0, 40}}};
  for (int evaluations = 1; evaluations < 12; ++evaluations) {
    int flown = 0;
    const GainSearch search = searchGains(start, {evaluations, 1.5, 6.0}, [&](const std::vector<Gain>& gains) {
      ++flown;
      return valley(gains, 0.5);
    });
    EXPECT_LE(flown, evaluations);
    EXPECT_LE(search.after, search.before);
  }
}

TEST(GainSearch, StaysWithinBoundsAndReach) {
  const std::vector<Gain> start = {{"p", 1.0, {0, 1.2}}, {"d", 1.0, {0, 40}}};
  const GainSearch search =
      searchGains(start, {100, 1.5, 2.0}, [](const std::vector<Gain>& gains) { return valley(gains, 10.0); });
  EXPECT_DOUBLE_EQ(search.gains[0].value, 1.2);
  EXPECT_DOUBLE_EQ(search.gains[1].value, 2.0);
}

}  // namespace
}  // namespace swiftlet::control
