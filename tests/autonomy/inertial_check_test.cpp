// Inertial samples that contradict the AHRS and the thrust.
#include "autonomy/inertial/inertial_check.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/geometry.hpp"
#include "tests/support/allocations/counted_allocations.hpp"

namespace swiftlet::autonomy {
namespace {

using common::ImuSample;
using common::Time;
using Eigen::Vector3d;

/// A vehicle that hovers, with samples at 200 Hz whose noise is that of shaking rotors.
class InertialCheckStory : public testing::Test {
 protected:
  ImuSample feed(double seconds, const Vector3d& force_off_m_s2 = Vector3d::Zero(), double rate_off_rad_s = 0.0) {
    ImuSample used;
    for (const double end_s = now_s_ + seconds; now_s_ < end_s - 1e-9;) {
      now_s_ += 0.005;
      yaw_rad_ += 0.005 * turn_rad_s_;
      const double shake = std::sin(613.0 * now_s_);
      sample_.stamps = {Time::fromSeconds(now_s_), Time::fromSeconds(now_s_ + 0.002)};
      sample_.angular_velocity_body_rad_s = {rate_off_rad_s, 0.01 * shake, turn_rad_s_ + rate_off_rad_s};
      sample_.specific_force_body_m_s2 =
          Vector3d(0.7 * shake, -0.7 * shake, 9.81 * context_.thrust_over_hover + 0.7 * shake) + force_off_m_s2;
      sample_.rotation_ahrs_body = common::quaternionFrom({0.001 * shake, 0.0, yaw_rad_});
      check_.vehicleIs(context_);
      used = check_.checked(sample_);
    }
    return used;
  }

  InertialCheck check_;
  InertialContext context_{true, false, true, 1.0};
  ImuSample sample_;
  double now_s_ = 0.0, yaw_rad_ = 0.0, turn_rad_s_ = 0.0;
};

TEST_F(InertialCheckStory, GoodSamplesAreUsedAsTheyAre) {
  feed(1.0);
  turn_rad_s_ = 1.0;
  ImuSample used = feed(1.0);
  EXPECT_EQ(used.angular_velocity_body_rad_s, sample_.angular_velocity_body_rad_s);
  context_.thrust_over_hover = 1.3;
  used = feed(1.0);
  EXPECT_EQ(used.specific_force_body_m_s2, sample_.specific_force_body_m_s2);
  EXPECT_EQ(check_.fault(), "");
}

TEST_F(InertialCheckStory, APushOfAHandIsMotionAndNoFault) {
  feed(1.0);
  feed(0.1, {15.0, 0.0, 0.0});
  EXPECT_EQ(check_.fault(), "");
  feed(0.3);
  EXPECT_EQ(check_.fault(), "");
}

TEST_F(InertialCheckStory, APushFromBelowIsMotionOnceItIsOver) {
  feed(1.0);
  double true_m_s = 0.0, used_m_s = 0.0;
  for (int i = 0; i < 60; ++i) {
    const ImuSample used = feed(0.005, {0.0, 0.0, i < 20 ? 10.0 : 0.0});
    true_m_s += 0.005 * sample_.specific_force_body_m_s2.z();
    used_m_s += 0.005 * used.specific_force_body_m_s2.z();
    EXPECT_EQ(check_.fault(), "");
  }
  EXPECT_NEAR(used_m_s, true_m_s, 0.03) << "half of one replaced sample's spread is left";
}

TEST_F(InertialCheckStory, OneShakeAfterAnotherIsAFault) {
  feed(1.0);
  for (int i = 0; i < 4; ++i) feed(0.1, {0.0, 0.0, 10.0}), feed(0.1);
  EXPECT_NE(check_.fault(), "");
}

TEST_F(InertialCheckStory, AWrongAccelerometerIsReplacedByTheThrust) {
  feed(1.0);
  const ImuSample used = feed(0.3, {0.0, 0.0, 6.0});
  const double spread_m_s2 = InertialCheck::kImpliedSpread_m_s2;
  EXPECT_NEAR(std::abs(used.specific_force_body_m_s2.z() - 9.81), spread_m_s2, 0.1);
  const ImuSample next = feed(0.005, {0.0, 0.0, 6.0});
  EXPECT_NEAR(0.5 * (used.specific_force_body_m_s2.z() + next.specific_force_body_m_s2.z()), 9.81, 0.1);
  EXPECT_NE(check_.fault().find("the accelerometer contradicts the thrust by"), std::string::npos) << check_.fault();
}

TEST_F(InertialCheckStory, AVehicleThatLosesThrustIsBelieved) {
  feed(1.0);
  const ImuSample used = feed(1.0, {0.0, 0.0, -4.4});
  EXPECT_EQ(used.specific_force_body_m_s2, sample_.specific_force_body_m_s2);
  EXPECT_EQ(check_.fault(), "");
}

TEST_F(InertialCheckStory, WrongGyroscopesAreReplacedByTheAhrs) {
  turn_rad_s_ = 0.5;
  feed(1.0);
  const ImuSample used = feed(0.15, Vector3d::Zero(), 1.0);
  EXPECT_NEAR(used.angular_velocity_body_rad_s.z(), 0.5, 0.05);
  EXPECT_NEAR(used.angular_velocity_body_rad_s.x(), 0.0, 0.05);
  feed(0.5);
  EXPECT_NE(check_.fault(), "") << "trusted again only after a while";
  feed(1.0);
  EXPECT_EQ(check_.fault(), "");
}

TEST_F(InertialCheckStory, NearTheGroundTheGroundMayCarryTheWeightAndNoMore) {
  context_.near_ground = true;
  context_.thrust_over_hover = 0.5;
  feed(1.0, {0.0, 0.0, 0.5 * 9.81});
  EXPECT_EQ(check_.fault(), "") << "it stands with half the thrust of a hover";
  feed(0.1, {0.0, 0.0, 30.0});
  EXPECT_EQ(check_.fault(), "") << "it touches down";
  feed(0.5, {0.0, 0.0, 0.5 * 9.81 + 6.0});
  EXPECT_NE(check_.fault().find("the accelerometer contradicts the thrust by 6"), std::string::npos) << check_.fault();
}

TEST_F(InertialCheckStory, OnTheGroundNothingIsCompared) {
  context_.airborne = false;
  feed(0.5, {5.0, 0.0, 5.0}, 2.0);
  EXPECT_EQ(check_.fault(), "");
}

TEST_F(InertialCheckStory, ASampleAllocatesNothing) {
  feed(1.0);
  const long before = test_support::allocations;
  feed(1.0);
  feed(1.0, {0.0, 0.0, 6.0}, 1.0);
  feed(3.0);
  EXPECT_EQ(test_support::allocations - before, 0) << "good, contradicted, and trusted again";
  EXPECT_FALSE(check_.contradicted());
}

/// A sum with one of them in it is no number, and contradicts nothing.
TEST_F(InertialCheckStory, WhatIsNotFiniteHidesNoFault) {
  feed(1.0);
  feed(0.1, {NAN, 0.0, 0.0});
  feed(0.3);
  EXPECT_EQ(check_.fault(), "");
  for (int i = 0; i < 20; ++i) {
    feed(0.01, {0.0, 0.0, 6.0});
    const ImuSample used = feed(0.005, {0.0, 0.0, NAN});
    EXPECT_TRUE(std::isnan(used.specific_force_body_m_s2.z())) << "it is given back as it is";
  }
  EXPECT_NE(check_.fault().find("the accelerometer contradicts the thrust"), std::string::npos) << check_.fault();
}

TEST_F(InertialCheckStory, RatesThatAreNotFiniteAreNoFault) {
  feed(1.0);
  feed(0.05, Vector3d::Zero(), NAN);
  EXPECT_EQ(check_.fault(), "");
  feed(0.3);
  EXPECT_EQ(check_.fault(), "");
}

}  // namespace
}  // namespace swiftlet::autonomy
