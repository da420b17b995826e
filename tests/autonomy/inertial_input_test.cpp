// Inertial samples that take the place of measured ones: predicted from the setpoints, only in the air, only while the
// sensor gives nothing that can be used.
#include "autonomy/inertial/inertial_input.hpp"

#include <cmath>

#include <vector>

#include <gtest/gtest.h>

#include "common/geometry.hpp"

namespace swiftlet::autonomy {
namespace {

using common::ImuSample;
using common::Time;

class InertialInputStory : public testing::Test {
 protected:
  /// Measured samples every 5 ms, level; each number differs from one to the next.
  void measure(double seconds, double force_off_m_s2 = 0.0) {
    for (const double end_s = now_s_ + seconds; now_s_ < end_s - 1e-9;) {
      now_s_ += 0.005;
      ImuSample sample;
      sample.angular_velocity_body_rad_s = {1e-4 * std::sin(900.0 * now_s_), 0, 0};
      sample.specific_force_body_m_s2 = {0, 1e-3 * std::sin(700.0 * now_s_), 9.81 + force_off_m_s2};
      sample.rotation_ahrs_body = common::quaternionFrom({1e-3 * std::sin(now_s_), 0, 0});
      sample.stamps = {Time::fromSeconds(now_s_ - 0.002), Time::fromSeconds(now_s_)};
      taken_ += input_.take(sample) ? 1 : 0;
    }
  }
  /// Ticks of the control without a sample; returns what was predicted.
  std::vector<ImuSample> silence(double seconds) {
    std::vector<ImuSample> samples;
    for (const double end_s = now_s_ + seconds; now_s_ < end_s - 1e-9;) {
      now_s_ += 0.01;
      while (const auto sample = input_.predicted(Time::fromSeconds(now_s_))) samples.push_back(*sample);
      fly();
    }
    return samples;
  }
  void fly() {
    setpoint_.stamp = Time::fromSeconds(now_s_);
    input_.flown(setpoint_, {airborne_, false, applies_, thrust_over_hover_});
  }

  common::EventLog log_;
  InertialInput input_{0.2, log_};
  common::Setpoint setpoint_;
  double thrust_over_hover_ = 1.0;
  bool airborne_ = true, applies_ = true;
  double now_s_ = 1.0;
  int taken_ = 0;
};

TEST_F(InertialInputStory, MeasuredSamplesAreUsedWhileTheyCome) {
  fly();
  measure(1.0);
  EXPECT_EQ(taken_, 200);
  EXPECT_FALSE(input_.predicted(Time::fromSeconds(now_s_)));
  EXPECT_TRUE(silence(0.05).empty()) << "a short gap";
}

TEST_F(InertialInputStory, InSilenceTheSetpointsPredictTheAttitude) {
  fly();
  measure(0.5);
  setpoint_.roll_rad = 0.1;
  setpoint_.yaw_rate_rad_s = 0.2;
  thrust_over_hover_ = 1.1;
  fly();
  const std::vector<ImuSample> samples = silence(1.0);
  ASSERT_GE(samples.size(), 95U);
  for (std::size_t i = 1; i < samples.size(); ++i)
    EXPECT_NEAR((samples[i].stamps.measured - samples[i - 1].stamps.measured).seconds(), 0.01, 1e-9);
  const ImuSample& last = samples.back();
  EXPECT_NEAR((last.stamps.arrived - last.stamps.measured).seconds(), 0.002, 0.0101) << "the delay of measured ones";
  const common::RollPitchYaw attitude = common::rollPitchYaw(last.rotation_ahrs_body);
  EXPECT_NEAR(attitude.roll_rad, 0.1, 0.002);
  EXPECT_NEAR(attitude.pitch_rad, 0.0, 1e-3);
  EXPECT_NEAR(attitude.yaw_rad, 0.2 * static_cast<double>(samples.size()) * 0.01, 1e-6);
  EXPECT_NEAR(last.angular_velocity_body_rad_s.norm(), 0.2, 0.01);
  EXPECT_NEAR(last.specific_force_body_m_s2.z(), 1.1 * 9.81, 0.01);
  EXPECT_EQ(last.specific_force_body_m_s2.head<2>().norm(), 0.0);
}

TEST_F(InertialInputStory, AContradictionThatLastsEndsInALanding) {
  const auto mustLandFor = [&] { return input_.mustLandFor(Time::fromSeconds(now_s_)); };
  fly();
  measure(1.0);
  measure(1.0, 6.0);
  EXPECT_TRUE(input_.contradicted());
  EXPECT_EQ(mustLandFor(), "");
  measure(1.0, 6.0);
  EXPECT_EQ(mustLandFor(), "the accelerometer contradicts the thrust by 6.0 m/s^2 along its axis");
  EXPECT_EQ(log_.take().size(), 1U);
  measure(0.9);
  EXPECT_TRUE(input_.contradicted()) << "trusted again only after a while";
  measure(0.2);
  EXPECT_FALSE(input_.contradicted());
  EXPECT_EQ(mustLandFor(), "");
  EXPECT_EQ(log_.take().back().text, "inertial samples trusted again");
}

TEST_F(InertialInputStory, OnTheGroundNothingIsPredicted) {
  airborne_ = false;
  fly();
  measure(0.5);
  EXPECT_TRUE(silence(1.0).empty());
}

TEST_F(InertialInputStory, WhileAPilotFliesNothingIsPredicted) {
  applies_ = false;
  fly();
  measure(0.5);
  EXPECT_TRUE(silence(1.0).empty());
}

TEST_F(InertialInputStory, BeforeTheFirstSampleNothingIsPredicted) {
  fly();
  EXPECT_TRUE(silence(1.0).empty());
}

TEST_F(InertialInputStory, ThePredictionEndsWithTheSilenceAndAfterItsLongestTime) {
  fly();
  measure(0.5);
  EXPECT_FALSE(silence(1.0).empty());
  measure(0.1);
  EXPECT_TRUE(silence(0.05).empty()) << "measured samples are used again";
  const std::vector<ImuSample> samples = silence(30.0);
  ASSERT_FALSE(samples.empty());
  EXPECT_NEAR((samples.back().stamps.measured - samples.front().stamps.measured).seconds(), 15.0, 0.1);
}

}  // namespace
}  // namespace swiftlet::autonomy
