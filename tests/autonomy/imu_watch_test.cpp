// Inertial samples that cannot be used: silent, repeated, or with a stopped AHRS.
#include "autonomy/inertial/imu_watch.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/geometry.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;

class ImuWatchStory : public testing::Test {
 protected:
  /// Samples every 5 ms. Each number differs from one to the next, unless it is stopped.
  void feed(double seconds, bool stopped = false, bool ahrs_stopped = false) {
    for (const double end_s = now_s_ + seconds; now_s_ < end_s - 1e-9;) {
      now_s_ += 0.005;
      if (!stopped && std::isfinite(turn_rad_s_)) {
        if (!rates_stopped_)
          sample_.angular_velocity_body_rad_s = {turn_rad_s_ + 1e-4 * std::sin(900.0 * now_s_), 0, 0};
        if (!force_stopped_) sample_.specific_force_body_m_s2 = {0, 1e-3 * std::sin(700.0 * now_s_), 9.81};
        if (!ahrs_stopped) sample_.rotation_ahrs_body = common::quaternionFrom({1e-3 * std::sin(now_s_), 0, 0});
      }
      if (!std::isfinite(turn_rad_s_)) sample_.angular_velocity_body_rad_s.x() = turn_rad_s_;
      sample_.stamps = {Time::fromSeconds(now_s_), Time::fromSeconds(now_s_ + 0.002)};
      watch_.add(sample_);
    }
  }
  std::string_view fault(double later_s = 0.0) const { return watch_.fault(Time::fromSeconds(now_s_ + later_s)); }

  ImuWatch watch_;
  common::ImuSample sample_;
  double now_s_ = 0.0;
  double turn_rad_s_ = 0.0;
  bool rates_stopped_ = false, force_stopped_ = false;
};

TEST_F(ImuWatchStory, NothingIsWrongBeforeTheFirstSampleAndWithGoodOnes) {
  EXPECT_EQ(fault(10.0), "");
  feed(2.0);
  EXPECT_EQ(fault(), "");
  EXPECT_EQ(fault(0.08), "") << "a short gap";
}

TEST_F(ImuWatchStory, SilenceIsNoticedWithinATenthOfASecond) {
  feed(1.0);
  EXPECT_EQ(fault(0.11), "no inertial samples");
  feed(0.1);
  EXPECT_EQ(fault(), "");
}

TEST_F(ImuWatchStory, RepeatedSamplesAreNoticedWithinATenthOfASecond) {
  feed(1.0);
  feed(0.03, true);
  EXPECT_EQ(fault(), "") << "a sample given a few times";
  feed(0.05, true);
  EXPECT_EQ(fault(), "the inertial samples repeat");
  feed(0.01);
  EXPECT_EQ(fault(), "");
}

TEST_F(ImuWatchStory, GyroscopesOrAccelerometersThatRepeatAloneAreNoticedInAHover) {
  feed(1.0);
  rates_stopped_ = true;
  feed(0.15);
  EXPECT_EQ(fault(), "") << "coarse gyroscopes";
  feed(0.05);
  EXPECT_EQ(fault(), "the rates of the gyroscopes are frozen");
  rates_stopped_ = false;
  force_stopped_ = true;
  feed(0.2);
  EXPECT_EQ(fault(), "the forces of the accelerometers are frozen");
  force_stopped_ = false;
  feed(0.01);
  EXPECT_EQ(fault(), "");
}

TEST_F(ImuWatchStory, SamplesThatAreNotFiniteCountAsNone) {
  feed(1.0);
  turn_rad_s_ = std::nan("");
  feed(0.05);
  EXPECT_EQ(fault(), "") << "a few bad samples";
  feed(0.05);
  EXPECT_EQ(fault(), "the inertial samples are not finite");
  turn_rad_s_ = 0.0;
  feed(0.01);
  EXPECT_EQ(fault(), "");
}

TEST_F(ImuWatchStory, SamplesThatArriveLateAreNotOfThePresent) {
  feed(1.0);
  sample_.angular_velocity_body_rad_s.x() += 1e-3;
  sample_.rotation_ahrs_body = common::quaternionFrom({0.01, 0, 0});
  sample_.stamps = {Time::fromSeconds(now_s_ + 0.005), Time::fromSeconds(now_s_ + 0.125)};
  watch_.add(sample_);
  EXPECT_EQ(fault(0.125), "the inertial samples are late");
}

TEST_F(ImuWatchStory, AnAttitudeWithoutItsNoiseIsThatOfAStoppedAhrsInAHoverToo) {
  feed(1.0);
  feed(0.04, false, true);
  EXPECT_EQ(fault(), "") << "an AHRS that is slower than the gyroscopes";
  feed(0.05, false, true);
  EXPECT_EQ(fault(), "the attitude of the AHRS is frozen");
  feed(0.01);
  EXPECT_EQ(fault(), "");
}

}  // namespace
}  // namespace swiftlet::autonomy
