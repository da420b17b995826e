// Which odometry the filter uses, as a story of Tomic 2012, Fig. 9.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "perception/fusion/odometry_choice.hpp"

namespace swiftlet::perception {
namespace {

using common::Time;

constexpr auto kLaser = OdometrySource::kLaser, kVision = OdometrySource::kVision;
constexpr double kNothing = OdometryChoice::kNothing;

TEST(OdometryChoice, TheFlightThroughTheWindowSwitchesAsInThePaper) {
  OdometryChoice choice(OdometryRule::kBest);
  const auto at = [](double s) { return Time::fromSeconds(s); };
  EXPECT_FALSE(choice.measured(kLaser, 0.006, at(0.0)));
  EXPECT_FALSE(choice.measured(kVision, kNothing, at(0.1))) << "too near to the ground";
  EXPECT_TRUE(choice.uses(kLaser, at(0.1)));
  EXPECT_FALSE(choice.uses(kVision, at(0.1)));

  EXPECT_FALSE(choice.measured(kVision, 0.003, at(0.4))) << "at 0.7 m the depths become available";
  EXPECT_FALSE(choice.measured(kLaser, 0.006, at(0.5)));
  EXPECT_FALSE(choice.measured(kVision, 0.003, at(0.7)));
  EXPECT_FALSE(choice.measured(kLaser, 0.006, at(0.9)));
  const auto up = choice.measured(kVision, 0.003, at(1.2));
  ASSERT_TRUE(up) << "and stay";
  EXPECT_EQ(up->from, kLaser);
  EXPECT_EQ(up->to, kVision);
  EXPECT_DOUBLE_EQ(up->from_m, 0.006);
  EXPECT_DOUBLE_EQ(up->to_m, 0.003);
  EXPECT_FALSE(choice.uses(kLaser, at(1.2)));

  EXPECT_FALSE(choice.measured(kLaser, 0.006, at(1.3)));
  EXPECT_FALSE(choice.measured(kVision, kNothing, at(1.45))) << "one pair may fail";
  EXPECT_FALSE(choice.measured(kLaser, 0.006, at(1.6)));
  const auto blurred = choice.measured(kVision, kNothing, at(1.7));
  ASSERT_TRUE(blurred) << "the pictures are blurred";
  EXPECT_EQ(blurred->to, kLaser);
  EXPECT_TRUE(std::isinf(blurred->from_m));

  EXPECT_FALSE(choice.measured(kVision, 0.004, at(1.95))) << "a sharp one among the blurred";
  EXPECT_FALSE(choice.measured(kVision, kNothing, at(2.2)));
  EXPECT_FALSE(choice.measured(kVision, kNothing, at(2.45)));
  EXPECT_FALSE(choice.measured(kLaser, 0.006, at(2.5)));
  EXPECT_FALSE(choice.measured(kVision, 0.004, at(2.7))) << "behind the window";
  EXPECT_FALSE(choice.measured(kLaser, kNothing, at(2.8)));
  ASSERT_TRUE(choice.measured(kLaser, kNothing, at(3.0))) << "the sun blinds the laser";
  EXPECT_FALSE(choice.measured(kVision, 0.02, at(3.1))) << "poor, but there is no other";
  EXPECT_TRUE(choice.uses(kVision, at(3.1)));
}

/// Pairs come four times a second, scans ten times; the pairs of some turns are missing or bring nothing.
struct Turns {
  OdometryChoice choice{OdometryRule::kBest};
  double longest_without_s = 0.0;  ///< Of what the filter uses.
  int switches = 0, laser_used = 0;

  void fly(double until_s, const std::function<double(int)>& pair_deviation_m, double laser_deviation_m = 0.01) {
    double used_s = 0.0;
    const auto use = [&](OdometrySource source, double deviation_m, double now_s) {
      switches += choice.measured(source, deviation_m, Time::fromSeconds(now_s)) ? 1 : 0;
      if (!std::isfinite(deviation_m) || !choice.uses(source, Time::fromSeconds(now_s))) return;
      longest_without_s = std::max(longest_without_s, now_s - used_s);
      used_s = now_s;
      if (source == kLaser) ++laser_used;
    };
    for (int tick = 1; 0.01 * tick < until_s; ++tick) {
      if (tick % 10 == 3) use(kLaser, laser_deviation_m, 0.01 * tick);
      if (tick % 25 != 0) continue;
      const double deviation_m = pair_deviation_m(tick / 25);
      if (deviation_m > 0.0) use(kVision, deviation_m, 0.01 * tick);
    }
  }
};

// The filter takes the position for lost after 0.5 s (FusionConfig::horizontal_timeout_s).
TEST(OdometryChoice, TheOtherSensorStandsInFromTheFirstTurnThatBringsNothing) {
  for (const double nothing : {kNothing, -1.0}) {  // It says so, or the pair is lost.
    Turns turns;
    turns.fly(8.0, [&](int pair) { return pair < 12 ? 0.003 : nothing; });
    EXPECT_EQ(turns.switches, 2);
    EXPECT_LT(turns.longest_without_s, 0.42) << nothing;
  }
}

TEST(OdometryChoice, ASensorThatStandsInForALostPairIsNoSwitch) {
  Turns turns;
  turns.fly(4.0, [](int) { return 0.003; });
  const int before = turns.laser_used;
  EXPECT_EQ(turns.switches, 1);
  Turns lossy;
  lossy.fly(8.0, [](int pair) { return pair == 20 ? -1.0 : 0.003; });
  EXPECT_EQ(lossy.switches, 1);
  EXPECT_GT(lossy.laser_used, before);
  EXPECT_LE(lossy.laser_used, before + 2) << "while the next pair is awaited";
  EXPECT_LT(lossy.longest_without_s, 0.42);
}

TEST(OdometryChoice, ABlindSensorStandsInForNoOther) {
  Turns turns;
  turns.fly(3.0, [](int) { return 0.003; });
  OdometryChoice& choice = turns.choice;
  EXPECT_FALSE(choice.measured(kVision, kNothing, Time::fromSeconds(3.0)));
  EXPECT_TRUE(choice.uses(kLaser, Time::fromSeconds(3.01))) << "it measured just before";
  EXPECT_FALSE(choice.measured(kLaser, kNothing, Time::fromSeconds(3.03)));
  EXPECT_FALSE(choice.uses(kLaser, Time::fromSeconds(3.04)));
}

TEST(OdometryChoice, TwoThatAreAlikeDoNotTakeTurns) {
  OdometryChoice choice(OdometryRule::kBest);
  int switches = 0;
  for (int i = 0; i < 100; ++i) {
    const Time now = Time::fromSeconds(0.1 * i);
    switches += choice.measured(kLaser, 0.005 * (1.0 + 0.1 * std::sin(i)), now) ? 1 : 0;
    switches += choice.measured(kVision, 0.005 * (1.0 + 0.1 * std::cos(i)), now) ? 1 : 0;
  }
  EXPECT_EQ(switches, 0);
}

TEST(OdometryChoice, ASensorThatFallsSilentIsLeft) {
  OdometryChoice choice(OdometryRule::kBest);
  choice.measured(kLaser, kNothing, Time::fromSeconds(0.0));
  ASSERT_TRUE(choice.measured(kVision, 0.002, Time::fromSeconds(0.1)));
  std::optional<OdometrySwitch> change;
  double left_s = 0.0;
  for (int i = 2; i < 20 && !change; ++i) change = choice.measured(kLaser, 0.01, Time::fromSeconds(left_s = 0.1 * i));
  ASSERT_TRUE(change);
  EXPECT_EQ(change->to, kLaser);
  EXPECT_NEAR(left_s, 0.8, 0.11);
}

TEST(OdometryChoice, AllUsesBothAndSwitchesNever) {
  OdometryChoice choice(OdometryRule::kAll);
  EXPECT_FALSE(choice.measured(kLaser, 1.0, Time::fromSeconds(0.0)));
  EXPECT_FALSE(choice.measured(kVision, 0.001, Time::fromSeconds(0.0)));
  EXPECT_TRUE(choice.uses(kLaser, Time::fromSeconds(0.0)));
  EXPECT_TRUE(choice.uses(kVision, Time::fromSeconds(0.0)));
}

TEST(OdometryChoice, ComparesTheHorizontalPartOfBothKinds) {
  const Time from = Time::fromSeconds(1.0), to = Time::fromSeconds(1.1);
  Eigen::Matrix3d planar = Eigen::Vector3d(9e-6, 4e-6, 16e-6).asDiagonal();
  EXPECT_NEAR(deviation_m(measuredRelativePose(from, to, {}, planar)), 0.005, 1e-9);
  Eigen::Matrix<double, 6, 6> spatial = Eigen::Matrix<double, 6, 6>::Identity();
  spatial.diagonal() << 4e-6, 9e-6, 1.0, 1.0, 1.0, 16e-6;
  EXPECT_NEAR(deviation_m(measuredRelativePose3(from, to, {}, spatial)), 0.005, 1e-9);
  common::UnobservableMotion along;
  along.change = Eigen::Vector3d(1.0, 0.0, 0.0);
  EXPECT_TRUE(std::isinf(deviation_m(measuredRelativePose(from, to, {}, planar, along))));
}

}  // namespace
}  // namespace swiftlet::perception
