// The learned table of hover commands: laws that hold for every flight, and stories of vehicles unlike their sheet.
#include "control/thrust_table.hpp"
#include "common/gravity.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/random.hpp"
#include "control/margin_limits.hpp"
#include "control/thrust_model.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::control {
namespace {

using common::VehicleConfig;

const VehicleConfig kSheet;
using test_support::HasProblem;

constexpr double kStep_s = 0.01;

/// A vehicle whose true hover command is the sheet's times `factor`, with another exponent of the voltage.
struct TrueVehicle {
  double factor = 1.0, exponent = 2.0;
  VehicleConfig sheet;

  double hover(double voltage_v) const {
    return factor * sheet.mass_kg * common::kGravity_m_s2 / sheet.max_thrust_n *
           std::pow(voltage_v / sheet.battery_full_v, -exponent);
  }
};

/// Flies down the voltages at a constant rate; the controller's integral is ideal.
void discharge(ThrustTable& table, const TrueVehicle& truth, double from_v, double to_v, double seconds) {
  const int ticks = static_cast<int>(seconds / kStep_s);
  for (int i = 0; i < ticks; ++i) {
    const double voltage_v = from_v + (to_v - from_v) * i / ticks;
    table.learn(voltage_v, 0.02 * std::log(truth.hover(voltage_v) / table.hoverCommand(voltage_v)), kStep_s);
  }
}

TEST(ThrustTable, StartsFromTheDataSheet) {
  const ThrustTable table(kSheet);
  for (double voltage_v = 8.5; voltage_v < 13.0; voltage_v += 0.1)
    EXPECT_NEAR(table.hoverCommand(voltage_v), table.sheetCommand(voltage_v), 0.002) << voltage_v;
}

TEST(ThrustTable, LearnsAWeakVehicleAndPredictsVoltagesItHasNotSeen) {
  ThrustTable table(kSheet);
  const TrueVehicle weak{1.25, 2.0, {}};
  discharge(table, weak, 12.2, 12.0, 20.0);
  for (double voltage_v = 9.5; voltage_v < 12.6; voltage_v += 0.1)
    EXPECT_NEAR(table.hoverCommand(voltage_v), weak.hover(voltage_v), 0.02 * weak.hover(voltage_v)) << voltage_v;
}

TEST(ThrustTable, LearnsAnotherLawOfTheVoltageAndKeepsWhatItLearnedAtOthers) {
  ThrustTable table(kSheet);
  const TrueVehicle other{1.1, 1.3, {}};
  discharge(table, other, 12.4, 10.2, 400.0);
  for (double voltage_v = 10.3; voltage_v < 12.25; voltage_v += 0.1)  // It began above the knot at 12.2 V.
    EXPECT_NEAR(table.hoverCommand(voltage_v), other.hover(voltage_v), 0.03 * other.hover(voltage_v)) << voltage_v;
}

TEST(ThrustTable, FollowsAVehicleThatHasBecomeHeavier) {
  ThrustTable table(kSheet);
  discharge(table, {1.0, 2.0, {}}, 12.4, 10.2, 600.0);
  const TrueVehicle loaded{1.2, 2.0, {}};
  discharge(table, loaded, 12.4, 10.2, 600.0);
  for (double voltage_v = 10.3; voltage_v < 12.25; voltage_v += 0.1)
    EXPECT_NEAR(table.hoverCommand(voltage_v), loaded.hover(voltage_v), 0.06 * loaded.hover(voltage_v)) << voltage_v;
}

TEST(ThrustTable, ReturnsTheStepAtTheVoltageAndNeverRisesWithIt) {
  rc::check([] {
    common::RandomStream random(static_cast<std::uint64_t>(*rc::gen::inRange(1, 1'000'000)), "thrust");
    ThrustTable table(kSheet);
    for (int i = 0; i < 300; ++i) {
      const double voltage_v = random.uniform(8.0, 13.3), before = table.hoverCommand(voltage_v);
      const double moved = table.learn(voltage_v, random.gaussian(0.05), random.uniform(0.0, 5.0));
      RC_ASSERT(std::abs(table.hoverCommand(voltage_v) - before * std::exp(moved)) < 1e-9);
      double last = 1e9;
      for (double at_v = 8.0; at_v < 13.3; at_v += 0.05) {
        RC_ASSERT(table.hoverCommand(at_v) <= last + 1e-12);
        last = table.hoverCommand(at_v);
      }
      for (const ThrustPoint& point : table.points()) {
        const double share = point.hover_command / table.sheetCommand(point.voltage_v);
        RC_ASSERT(std::abs(share - 1.0) <= ThrustTable::kMaxCorrection + 1e-9);
      }
    }
  });
}

TEST(ThrustTable, RemembersWhatAnotherTableLearned) {
  ThrustTable first(kSheet), second(kSheet);
  discharge(first, {1.2, 1.5, {}}, 12.4, 11.0, 100.0);
  second.recall(first.points());
  for (double voltage_v = 8.5; voltage_v < 13.0; voltage_v += 0.1)
    EXPECT_NEAR(second.hoverCommand(voltage_v), first.hoverCommand(voltage_v), 1e-9) << voltage_v;
  const auto points = second.points();
  EXPECT_EQ(points.size(), first.points().size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(points[i].seen_s, first.points()[i].seen_s, 1e-9);
}

TEST(ThrustTable, RecallsFewRowsByTheLawOfTheSheet) {
  ThrustTable table(kSheet);
  table.recall({{11.4, 0.8, 30.0}});
  EXPECT_NEAR(table.hoverCommand(11.4), 0.8, 0.01);
  EXPECT_NEAR(table.hoverCommand(12.6) / table.hoverCommand(11.4), std::pow(11.4 / 12.6, 2.0), 0.01);
  ThrustTable bounded(kSheet);
  bounded.recall({{11.4, 5.0, 30.0}});
  EXPECT_LT(bounded.hoverCommand(11.4), 1.61 * bounded.sheetCommand(11.4));
}

TEST(ThrustTable, NamesWhatIsWrongWithRows) {
  EXPECT_TRUE(problemsOf({{10.0, 0.9, 0}, {11.0, 0.9, 0}, {12.0, 0.7, 0}}).empty());
  EXPECT_THAT(problemsOf({{10.0, 0.9, 0}, {10.0, 0.8, 0}}), HasProblem("thrust.voltage-falls"));
  EXPECT_THAT(problemsOf({{10.0, 0.8, 0}, {11.0, 0.9, 0}}),
              HasProblem("thrust.command-rises", "", "0.8 at 10 V and 0.9 at 11 V"));
}

TEST(ThrustModel, MarginIsTheGreatestCommandOverThatOfTheHover) {
  ThrustModel model({}, {});
  model.observeVoltage(12.6, kStep_s);
  EXPECT_NEAR(model.margin(), 0.95 * 28.0 / (1.6 * common::kGravity_m_s2), 0.01);
  EXPECT_LT(model.marginAt(10.5), 0.72 * model.marginAt(12.6));
  model.setLearning(false);
  EXPECT_EQ(model.learn(1.0, kStep_s), 0.0);
  EXPECT_NEAR(model.correction(), 1.0, 0.002);
}

TEST(MarginLimits, ShrinkSmoothlyAndKeepTheBrakingDistance) {
  MarginLimits limits;
  EXPECT_EQ(limits.shareAt(1.5), 1.0);
  EXPECT_EQ(limits.shareAt(1.2), 1.0);
  EXPECT_NEAR(limits.shareAt(1.125), 0.5 * (1.0 + 0.35), 1e-12);
  EXPECT_EQ(limits.shareAt(0.9), 0.35);
  EXPECT_EQ(limits.shareAt(std::nan("")), limits.shareAt(0.9)) << "what is not known is not used";
  limits.observe(1.5, kStep_s);
  EXPECT_EQ(limits.acceleration(), 1.0);
  double last = 1.0;
  for (int i = 0; i < 1000; ++i) {
    limits.observe(1.05, kStep_s);
    EXPECT_LE(last - limits.acceleration(), 0.004);
    last = limits.acceleration();
    EXPECT_NEAR(limits.speed() * limits.speed() / limits.acceleration(), 1.0, 1e-12);
  }
  EXPECT_NEAR(last, 0.35, 0.01);
}

}  // namespace
}  // namespace swiftlet::control
