// Consumption, the time it leaves, and the charge that the path home takes.
#include "autonomy/energy/energy_monitor.hpp"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

constexpr double kCapacity_ah = 5.0, kLandShare = 0.12, kLeastMargin = 1.1;

class EnergyStory : public testing::Test {
 protected:
  /// Samples at 10 Hz of a battery whose capacity may differ from the believed one.
  void draw(double seconds, double current_a, bool airborne = true, double true_capacity_ah = kCapacity_ah,
            double voltage_v = 11.0) {
    for (int i = 0; i < static_cast<int>(10 * seconds); ++i) {
      now_s_ += 0.1;
      remaining_ -= 0.1 * current_a / (3600.0 * true_capacity_ah);
      const common::Time now = common::Time::fromSeconds(now_s_);
      monitor_.add({{now, now}, voltage_v, stands_still_.value_or(remaining_), ammeter_ ? current_a : 0.0}, airborne,
                   margin_, speed_m_s_);
    }
  }
  common::EnergyLayer layer(std::optional<double> home_m = std::nullopt) const {
    return monitor_.layer(common::Time::fromSeconds(now_s_), {home_m, trail_m_, landing_s_}, margin_, kLandShare,
                          kLeastMargin);
  }

  EnergyMonitor monitor_{EnergyConfig{}, common::VehicleConfig{}, 2.0};
  double now_s_ = 0.0;
  double remaining_ = 0.8;
  std::optional<double> stands_still_;  ///< What the gauge says, whatever is drawn.
  bool ammeter_ = true;
  double margin_ = 1.5;
  double speed_m_s_ = 0.5;
  double trail_m_ = 0.0;
  double landing_s_ = 0.0;
};

TEST_F(EnergyStory, SaysNothingOfTheFutureBeforeTheTakeOff) {
  EXPECT_FALSE(layer(5.0).home_share);
  draw(5.0, 1.0, false);
  EXPECT_FALSE(layer(5.0).seconds_left);
  EXPECT_FALSE(layer(5.0).home_share);
  EXPECT_DOUBLE_EQ(layer().battery_voltage_v, 11.0);
}

TEST_F(EnergyStory, TheTimeLeftEndsAtTheChargeOfTheLanding) {
  draw(5.0, 1.0, false);
  draw(10.0, 18.0);
  const double expected_s = (remaining_ - kLandShare) * 3600.0 * kCapacity_ah / 18.0;
  EXPECT_NEAR(layer().seconds_left.value(), expected_s, 0.01 * expected_s);
  EXPECT_NEAR(layer().power_w, 198.0, 1.0);
}

TEST_F(EnergyStory, ThePathHomeTakesItsTimeAndALanding) {
  landing_s_ = 5.0;
  draw(10.0, 18.0);
  const double expected = (20.0 / EnergyConfig{}.home_speed_m_s + 2.0 + 5.0) * 18.0 / (3600.0 * kCapacity_ah);
  EXPECT_NEAR(layer(20.0).home_share.value(), expected, 0.01 * expected);
}

TEST_F(EnergyStory, WithoutAPathTheLengthHomeIsThatOfTheTrail) {
  draw(10.0, 18.0);
  trail_m_ = 12.0;
  EXPECT_DOUBLE_EQ(layer().home_m.value(), 12.0);
  EXPECT_FALSE(layer().home_planned);
  EXPECT_NEAR(layer().home_share.value(), layer(12.0).home_share.value(), 1e-9);
  EXPECT_DOUBLE_EQ(layer(6.0).home_m.value(), 6.0);
  EXPECT_TRUE(layer(6.0).home_planned);
}

TEST_F(EnergyStory, TheSpeedFlownSoFarPredictsTheTime) {
  draw(10.0, 18.0);
  const double before = layer(20.0).home_share.value();
  for (int i = 0; i < 30'000; ++i) monitor_.followed(1.2, 0.01);
  EXPECT_LT(layer(20.0).home_share.value(), 0.7 * before);
}

TEST_F(EnergyStory, StopsBetweenViewpointsDoNotSlowThePathHome) {
  draw(10.0, 18.0);
  for (int leg = 0; leg < 100; ++leg) {
    for (int i = 0; i < 100; ++i) monitor_.followed(0.3, 0.01);
    for (int i = 0; i < 300; ++i) monitor_.followed(0.8, 0.01);
  }
  const double expected = (20.0 / 0.8 + 2.0) * 18.0 / (3600.0 * kCapacity_ah);
  EXPECT_NEAR(layer(20.0).home_share.value(), expected, 0.03 * expected);
}

TEST_F(EnergyStory, AWornBatteryIsNoticedByItsFuelGauge) {
  draw(100.0, 18.0, true, 4.0);
  EXPECT_NEAR(layer().seconds_left.value(), (remaining_ - kLandShare) * 3600.0 * 4.0 / 18.0, 10.0);
}

TEST_F(EnergyStory, ABatteryThatIsSilentIsCountedOnByItsCurrent) {
  draw(100.0, 18.0);
  EXPECT_EQ(monitor_.gaugeFault(common::Time::fromSeconds(now_s_ + 1.0)), "");
  now_s_ += 200.0;
  remaining_ -= 200.0 * 18.0 / (3600.0 * kCapacity_ah);
  EXPECT_EQ(monitor_.gaugeFault(common::Time::fromSeconds(now_s_)), "no battery sample for 2.5 s");
  EXPECT_NEAR(layer(20.0).battery_remaining, remaining_, 0.01);
  now_s_ += 1e4;
  EXPECT_EQ(layer().battery_remaining, 0.0);
}

TEST_F(EnergyStory, TheSpoolingMotorsAtTheStartAreForgottenInSeconds) {
  draw(1.0, 2.0);
  draw(5.0, 18.0);
  remaining_ = 0.8;
  draw(0.2, 18.0);
  const double left_s = (remaining_ - kLandShare) * 3600.0 * kCapacity_ah / 18.0;
  EXPECT_NEAR(layer().seconds_left.value(), left_s, 0.2 * left_s);
}

TEST_F(EnergyStory, NoTimeIsToldBeforeTheConsumptionOfTheFlightIsKnown) {
  for (int i = 0; i < 40; ++i) {
    draw(0.1, 1.5);  // The motors spool up.
    EXPECT_FALSE(layer().seconds_left);
  }
  double told_s = 0.0;
  for (int i = 0; i < 300; ++i) {
    draw(0.1, 18.0);
    if (const auto left_s = layer().seconds_left; left_s && told_s == 0.0) told_s = *left_s;
  }
  const double left_s = (remaining_ - kLandShare) * 3600.0 * kCapacity_ah / 18.0;
  EXPECT_GT(told_s, 0.0);
  EXPECT_NEAR(told_s, left_s, 0.4 * left_s) << "what is told first is near to what is told in the end";
  EXPECT_TRUE(layer(5.0).home_share);
}

TEST_F(EnergyStory, AGaugeThatStandsStillIsCountedOnByTheCurrent) {
  draw(50.0, 18.0);
  stands_still_ = remaining_;
  draw(40.0, 18.0);
  EXPECT_EQ(monitor_.gaugeFault(common::Time::fromSeconds(now_s_)), "") << "coarse gauges rest too";
  draw(200.0, 18.0);
  EXPECT_EQ(monitor_.gaugeFault(common::Time::fromSeconds(now_s_)),
            "the gauge has not moved while 5 % of the capacity were drawn");
  EXPECT_NEAR(layer().battery_remaining, remaining_, 0.01);
  stands_still_.reset();
  draw(1.0, 18.0);
  EXPECT_EQ(monitor_.gaugeFault(common::Time::fromSeconds(now_s_)), "");
  EXPECT_DOUBLE_EQ(layer().battery_remaining, remaining_);
}

TEST_F(EnergyStory, WithoutAnAmmeterTheGaugeTellsTheCurrent) {
  ammeter_ = false;
  draw(40.0, 18.0);
  EXPECT_FALSE(layer(20.0).home_share) << "too little has been drawn to tell";
  draw(200.0, 18.0);
  const double without = layer(20.0).home_share.value();
  EXPECT_NEAR(without, (20.0 / EnergyConfig{}.home_speed_m_s + 2.0) * 18.0 / (3600.0 * kCapacity_ah), 0.2 * without);
}

TEST_F(EnergyStory, AfterACharge) {
  remaining_ = 0.95;
  draw(2340.0, 5.0);
  remaining_ = 0.95;
  draw(10.0, 0.5, false);
  draw(2000.0, 5.0);
  const double expected = (20.0 / EnergyConfig{}.home_speed_m_s + 2.0) * 5.0 / (3600.0 * kCapacity_ah);
  EXPECT_NEAR(layer(20.0).home_share.value(), expected, 0.05 * expected) << "what was charged is not capacity";
}

TEST_F(EnergyStory, TimeOnTheGroundIsNoTimeOfFlight) {
  ammeter_ = false;
  draw(240.0, 18.0);
  const double before = layer(20.0).home_share.value();
  draw(1800.0, 0.0, false);
  draw(240.0, 18.0);
  EXPECT_NEAR(layer(20.0).home_share.value(), before, 0.2 * before);
}

TEST_F(EnergyStory, OneCurrentThatIsNoNumberSpoilsNothing) {
  draw(20.0, 18.0);
  const double before = layer(20.0).home_share.value();
  now_s_ += 0.1;
  const common::Time now = common::Time::fromSeconds(now_s_);
  monitor_.add({{now, now}, 11.0, remaining_, std::nan("")}, true, margin_, speed_m_s_);
  draw(1.0, 18.0);
  EXPECT_NEAR(layer(20.0).home_share.value(), before, 0.02 * before);
}

TEST_F(EnergyStory, TheChargeOfTheLandingIsWhereTheThrustWillNotCarryTheWeight) {
  const BatteryCurve curve{common::VehicleConfig{}};
  const auto loaded_v = [&] { return curve.openCircuit_v(remaining_) - 0.5; };
  remaining_ = 1.0;
  const double full_v = loaded_v();
  std::optional<double> said, came;
  for (int second = 0; second < 900; ++second) {
    margin_ = 1.4 * std::pow(loaded_v() / full_v, 2);
    if (margin_ <= kLeastMargin && !came) came = remaining_;
    draw(1.0, 18.0, true, kCapacity_ah, loaded_v());
    if (remaining_ < 0.8 && !said) said = layer().land_share;
  }
  ASSERT_TRUE(said && came);
  EXPECT_GT(*came, 0.15);
  EXPECT_NEAR(*said, *came, 0.04) << "said at four fifths of the charge";
}

TEST_F(EnergyStory, ASteepFallNearFullDoesNotTurnTheVehicleBack) {
  const BatteryCurve curve{common::VehicleConfig{}};
  remaining_ = 1.0;
  for (int second = 0; second < 60; ++second) {
    const double voltage_v = curve.openCircuit_v(remaining_) - 0.5;
    margin_ = 1.6 * std::pow(voltage_v / 12.1, 2);
    draw(1.0, 18.0, true, kCapacity_ah, voltage_v);
  }
  EXPECT_LT(layer().land_share, 0.4);
}

TEST_F(EnergyStory, WithThrustToSpareTheChargeOfTheLandingIsTheConfigured) {
  draw(100.0, 18.0);
  EXPECT_DOUBLE_EQ(layer().land_share, kLandShare);
}

}  // namespace
}  // namespace swiftlet::autonomy
