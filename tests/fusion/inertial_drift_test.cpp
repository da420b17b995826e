// A taped flight given again, and the velocity by integrated acceleration alone.
#include "perception/fusion/inertial_drift.hpp"

#include <gtest/gtest.h>

namespace swiftlet::perception {
namespace {

using common::Time;

/// A vehicle that stands for a second and hovers then, turned by the yaw; the accelerometer has an error along x.
TapedFlight hover(double accelerometer_error_m_s2, double yaw_rad) {
  TapedFlight flight;
  common::ImuSample sample;
  sample.rotation_ahrs_body = common::quaternionFrom({0.0, 0.0, yaw_rad});
  flight.inputs.emplace_back(TapedRest{true});
  for (int i = 0; i <= 200 * 11; ++i) {
    const Time now = Time::fromSeconds(0.005 * i);
    sample.stamps = {now, now};
    sample.specific_force_body_m_s2 = {i > 200 ? accelerometer_error_m_s2 : 0.0, 0.0, 9.81};
    flight.inputs.emplace_back(sample);
    if (i == 200) {
      flight.inputs.emplace_back(TapedStart{0.15});
      flight.inputs.emplace_back(TapedRest{false});
    }
    if (i > 200 && i % 20 == 0) flight.truth.push_back({now, 0.3, Eigen::Vector3d::Zero(), {0.0, 0.0, 1.0}});
  }
  return flight;
}

TEST(TapedReplay, TellsEachInputOnceAndNoneBeforeItArrived) {
  TapedFlight flight = hover(0.0, 0.0);
  flight.truth.erase(flight.truth.begin(), flight.truth.begin() + 50);  // Inputs before the first truth are told too.
  TapedReplay replay(flight, FusionConfig{});
  std::size_t told = 0;
  Time newest;
  std::size_t instants = 0;
  while (const TrueMotion* truth = replay.next([&](const FilterInput& input) {
    EXPECT_EQ(input.index(), flight.inputs[told++].index());
    if (const auto* imu = std::get_if<common::ImuSample>(&input)) newest = imu->stamps.arrived;
  })) {
    EXPECT_EQ(newest, truth->stamp);
    EXPECT_EQ(replay.filter().newest(), truth->stamp);
    ++instants;
  }
  EXPECT_EQ(instants, flight.truth.size());
  EXPECT_EQ(told, flight.inputs.size());
  EXPECT_EQ(replay.next(), nullptr) << "the end stays the end";
}

TEST(InertialDrift, GrowsWithTheErrorOfTheAccelerometer) {
  for (const double yaw_rad : {0.0, 2.0}) {
    const auto velocities = inertialDrift(hover(0.1, yaw_rad), FusionConfig{});
    ASSERT_GT(velocities.size(), 90u);
    EXPECT_EQ(velocities.front().time_s, 0.0);
    EXPECT_NEAR(velocities.front().integrated_m_s, 0.0, 1e-9) << "it starts with the truth";
    const ForwardVelocity& last = velocities.back();
    EXPECT_NEAR(last.integrated_m_s, 0.1 * last.time_s, 0.01) << yaw_rad;
    EXPECT_EQ(last.true_m_s, 0.0);
  }
}

TEST(InertialDrift, IsNoneWithoutAnError) {
  EXPECT_NEAR(inertialDrift(hover(0.0, 1.0), FusionConfig{}).back().integrated_m_s, 0.0, 1e-9);
}

TEST(InertialDrift, OfAFlightWithoutTruthIsEmpty) {
  TapedFlight flight = hover(0.1, 0.0);
  flight.truth.clear();
  EXPECT_TRUE(inertialDrift(flight, FusionConfig{}).empty());
}

}  // namespace
}  // namespace swiftlet::perception
