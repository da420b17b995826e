// Taking off and landing, tick by tick: the height reference, and the signs by which they end.
#include "control/vertical_flight.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/emergency_descent.hpp"

namespace swiftlet::control {
namespace {

using common::Time;
using testing::HasSubstr;

class VerticalFlightStory : public testing::Test {
 protected:
  static constexpr double kStanding_m = 0.1;

  VerticalFlightStory() {
    place(kStanding_m);
    clock_.advance(Time::fromSeconds(10.0));
    flight_.start(clock_.now(), kStanding_m, kStanding_m);
    flight_.setGoal(1.0);
  }
  void place(double height_m) { state_.T_odom_body.position_m.z() = state_.height_above_ground_m = height_m; }
  void advance() {
    clock_.advance(clock_.now() + common::kControlPeriod);
    state_.stamp = state_.vertical_supported = clock_.now();
  }
  void spoolUp() {
    while (flight_.spoolUpShare(clock_.now())) advance();
  }
  /// The vehicle follows the reference, with this command.
  std::optional<VerticalFlight::End> climb(double seconds, double command) {
    for (const Time end = clock_.now() + common::Duration::fromSeconds(seconds); clock_.now() < end; advance()) {
      flight_.climb(clock_, state_, margin_);
      if (follows_) place(flight_.height_m());
      state_.velocity_odom_m_s.z() = follows_ ? flight_.rate_m_s() : 0.0;
      fastest_m_s_ = std::max(fastest_m_s_, flight_.rate_m_s());
      if (auto ended = flight_.takeOffEnd(clock_, state_, command, thrust_)) return ended;
    }
    return std::nullopt;
  }
  std::optional<std::string> stand(double seconds, double command) {
    state_.velocity_odom_m_s.setZero();
    for (const Time end = clock_.now() + common::Duration::fromSeconds(seconds); clock_.now() < end; advance()) {
      flight_.descend(clock_, state_, margin_, false);
      if (auto landed = flight_.touchedDown(clock_, state_, command, thrust_)) return landed;
    }
    return std::nullopt;
  }

  common::VehicleConfig vehicle_;
  ThrustModel thrust_{{}, vehicle_};
  MarginLimits margin_;
  TickClock clock_;
  common::VehicleState state_;
  VerticalFlight flight_{0.5, 0.4, 2.0};
  bool follows_ = true;
  double fastest_m_s_ = 0.0;
};

TEST_F(VerticalFlightStory, RefusesHeightsBelowItAndAboveTheGreatest) {
  EXPECT_EQ(flight_.refusal(1.0, kStanding_m), "");
  EXPECT_THAT(flight_.refusal(0.15, kStanding_m), HasSubstr("not above 0.20 m"));
  EXPECT_THAT(flight_.refusal(std::nan(""), kStanding_m), HasSubstr("not above"));
  EXPECT_THAT(flight_.refusal(2.1, kStanding_m), HasSubstr("greatest height, 2.00 m"));
}

TEST_F(VerticalFlightStory, SpoolsUpClimbsAndHovers) {
  EXPECT_EQ(flight_.spoolUpShare(clock_.now()), 0.0);
  spoolUp();
  EXPECT_FALSE(flight_.lifted());
  const auto end = climb(8.0, thrust_.hoverCommand());
  ASSERT_TRUE(end);
  EXPECT_EQ(end->input, FlightInput::kHoverReached);
  EXPECT_TRUE(flight_.lifted());
  EXPECT_NEAR(flight_.height_m(), 1.0, 0.02);
  EXPECT_NEAR(fastest_m_s_, 0.5, 1e-9);
}

TEST_F(VerticalFlightStory, GivesUpWhatItsThrustDoesNotLift) {
  spoolUp();
  follows_ = false;
  const auto end = climb(5.0, thrust_.clamped(1.0));
  ASSERT_TRUE(end);
  EXPECT_EQ(end->input, FlightInput::kLand);
  EXPECT_THAT(end->reason, HasSubstr("95 % of the thrust for 2.0 s"));
  EXPECT_LE(flight_.height_m(), kStanding_m + 0.3 + 1e-9) << "the lead of the reference is bounded";
}

TEST_F(VerticalFlightStory, GivesUpAHoverThatIsNeverReached) {
  spoolUp();
  follows_ = false;
  const auto end = climb(30.0, thrust_.hoverCommand());
  ASSERT_TRUE(end);
  EXPECT_THAT(end->reason, HasSubstr("not hovering after 17 s"));
}

TEST_F(VerticalFlightStory, LandsWhereTheGroundCarriesIt) {
  flight_.restart(kStanding_m, 0.0);
  EXPECT_FALSE(stand(2.0, 0.9 * thrust_.hoverCommand())) << "so much thrust carries it";
  const Time before = clock_.now();
  EXPECT_TRUE(stand(2.0, 0.5 * thrust_.hoverCommand()));
  EXPECT_NEAR((clock_.now() - before).seconds(), 0.3, 0.02);
}

TEST_F(VerticalFlightStory, LandsOnGlassAfterALongerTime) {
  flight_.restart(1.0, 0.0);
  place(1.0);
  const Time before = clock_.now();
  const auto landed = stand(5.0, 0.5 * thrust_.hoverCommand());
  ASSERT_TRUE(landed);
  EXPECT_THAT(*landed, HasSubstr("1.00 m over the ground that the beams measure"));
  EXPECT_NEAR((clock_.now() - before).seconds(), 3.0, 0.02);
}

TEST_F(VerticalFlightStory, SinksFasterWithoutAPositionAndSlowerNearTheGround) {
  flight_.restart(2.0, 0.0);
  place(2.0);
  const auto steady_m_s = [this](bool drifts) {
    for (int i = 0; i < 100; ++i, advance()) flight_.descend(clock_, state_, margin_, drifts);
    return -flight_.rate_m_s();
  };
  EXPECT_NEAR(steady_m_s(false), 0.4, 1e-9);
  EXPECT_NEAR(steady_m_s(true), EmergencyDescent::kDescent_m_s, 1e-9);
  place(0.3);
  EXPECT_TRUE(flight_.nearGround(state_));
  EXPECT_NEAR(steady_m_s(false), 0.2, 1e-9);
}

}  // namespace
}  // namespace swiftlet::control
