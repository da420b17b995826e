// The error-state filter as a whole: late measurements, consistency, outliers, silence, garbage.
#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fusion/synthetic_flight.hpp"

namespace swiftlet::perception {
namespace {

using common::Duration;
using common::Time;

void expectSameState(const ErrorStateFilter& a, const ErrorStateFilter& b, double tolerance) {
  const auto x = a.state(), y = b.state();
  EXPECT_EQ(x.stamp, y.stamp);
  EXPECT_LE((x.T_odom_body.position_m - y.T_odom_body.position_m).norm(), tolerance);
  EXPECT_LE((x.T_odom_body.rotation.coeffs() - y.T_odom_body.rotation.coeffs()).norm(), tolerance);
  EXPECT_LE((x.velocity_odom_m_s - y.velocity_odom_m_s).norm(), tolerance);
  EXPECT_LE((a.estimate().accelerometer_bias_m_s2 - b.estimate().accelerometer_bias_m_s2).norm(), tolerance);
  EXPECT_LE((a.estimate().covariance - b.estimate().covariance).cwiseAbs().maxCoeff(), tolerance);
}

TEST(ErrorStateFilter, LateMeasurementsGiveTheSameResultAsPunctualOnes) {
  SyntheticFlight flight(1, 12.0);
  const auto imu = flight.imuSamples();
  flight.delay_s = 0.0;
  auto on_time = flight.deliveries();
  auto late = on_time;
  for (Delivery& delivery : late) delivery.arrives += Duration::fromSeconds(0.173);
  ErrorStateFilter a({}), b({});
  // All measurements have arrived at the end.
  const auto last = Time::fromSeconds(11.5);
  std::erase_if(on_time, [&](const Delivery& d) { return d.arrives > last; });
  std::erase_if(late, [&](const Delivery& d) { return d.arrives > last + Duration::fromSeconds(0.173); });
  feed(a, imu, on_time, flight.restUntil());
  feed(b, imu, late, flight.restUntil());
  EXPECT_GT(b.counts().replays, 10 * a.counts().replays);
  EXPECT_EQ(a.counts().refused, 0u);
  EXPECT_EQ(b.counts().refused, 0u);
  expectSameState(a, b, 1e-12);
}

TEST(ErrorStateFilter, TheOrderOfArrivalDoesNotMatter) {
  SyntheticFlight flight(2, 8.0);
  const auto imu = flight.imuSamples();
  const auto in_order = flight.deliveries();
  ErrorStateFilter a({});
  feed(a, imu, in_order, flight.restUntil());
  for (int seed = 1; seed <= 3; ++seed) {
    common::RandomStream random(static_cast<std::uint64_t>(seed), "order");
    auto shuffled = in_order;
    for (Delivery& delivery : shuffled)
      if (delivery.order < 2) delivery.arrives += Duration::fromSeconds(random.uniform(0.0, 0.03));
    ErrorStateFilter b({});
    feed(b, imu, shuffled, flight.restUntil());
    EXPECT_EQ(b.counts().refused, 0u);
    expectSameState(a, b, 1e-12);
  }
}

TEST(ErrorStateFilter, TheSameInputGivesIdenticalResults) {
  SyntheticFlight flight(3, 6.0);
  const auto imu = flight.imuSamples();
  const auto deliveries = flight.deliveries();
  ErrorStateFilter a({}), b({});
  feed(a, imu, deliveries, flight.restUntil());
  feed(b, imu, deliveries, flight.restUntil());
  expectSameState(a, b, 0.0);
}

TEST(ErrorStateFilter, StartsLevelWithItsGyroscopeBiasEstimated) {
  SensorNoise noise;
  SyntheticFlight flight(5, 1.0, noise);
  ErrorStateFilter filter(withoutDrag());
  EXPECT_EQ(filter.health().status, FusionStatus::kNotInitialized);
  EXPECT_FALSE(filter.initialize(0.15));
  for (const auto& sample : flight.imuSamples()) filter.predict(sample);
  ASSERT_TRUE(filter.initialize(0.15));
  const auto angles = common::rollPitchYaw(filter.state().T_odom_body.rotation);
  // 0.08 m/s^2 of unknown accelerometer bias look like half a degree.
  EXPECT_NEAR(angles.roll_rad, 0.0, 0.012);
  EXPECT_NEAR(angles.pitch_rad, 0.0, 0.012);
  EXPECT_NEAR(angles.yaw_rad, 0.0, 1e-12);
  EXPECT_NEAR((filter.estimate().gyroscope_bias_rad_s - noise.gyroscope_bias).norm(), 0.0, 0.003);
  EXPECT_EQ(filter.state().T_odom_body.position_m, Eigen::Vector3d(0, 0, 0.15));
}

TEST(ErrorStateFilter, StartsWithoutAnAhrsAndTakesAForceForGravityOrForDragButNotForBoth) {
  SyntheticFlight flight(5, 8.0);
  auto imu = flight.imuSamples();
  for (auto& sample : imu) sample.rotation_ahrs_body.coeffs().setConstant(std::nan(""));
  const auto deliveries = flight.deliveries();
  ErrorStateFilter::Config with_drag;
  with_drag.use_ahrs = false;
  with_drag.use_gravity = true;
  ErrorStateFilter::Config without_drag = with_drag;
  without_drag.use_drag = false;
  ErrorStateFilter a(with_drag), b(without_drag), dropped({});
  feed(a, imu, deliveries, flight.restUntil());
  feed(b, imu, deliveries, flight.restUntil());
  ASSERT_TRUE(a.initialized());
  expectSameState(a, b, 0.0);
  const common::Pose3 truth = flight.motion.pose(8.0);
  EXPECT_LT((a.state().T_odom_body.position_m - truth.position_m).norm(), 0.1);
  EXPECT_LT(common::logSO3(truth.rotation.conjugate() * a.state().T_odom_body.rotation).head<2>().norm(), 0.03);
  for (const auto& sample : imu) dropped.predict(sample);
  EXPECT_EQ(dropped.counts().imu_dropped, imu.size()) << "with an AHRS a sample without attitude is a bad one";
}

TEST(ErrorStateFilter, RefusesToStartWhileMoving) {
  SyntheticFlight flight(6, 6.0);
  ErrorStateFilter filter(withoutDrag());
  for (const auto& sample : flight.imuSamples()) filter.predict(sample);
  EXPECT_THAT(filter.initialize(0.15).error(), testing::HasSubstr("moves"));
  EXPECT_FALSE(filter.initialize(std::nan("")));
}

TEST(ErrorStateFilter, OutliersAreGated) {
  SyntheticFlight flight(7, 12.0);
  const auto imu = flight.imuSamples();
  auto deliveries = flight.deliveries();
  // Every tenth scan is followed by a wild match against the same reference, every tenth height by a wild one.
  const auto count = deliveries.size();
  const Eigen::Matrix3d covariance = 1e-4 * Eigen::Matrix3d::Identity();
  for (std::size_t i = 300; i < count; i += 20) {
    const Time to = deliveries[i].arrives - Duration::fromSeconds(flight.delay_s);
    deliveries.push_back(
        {deliveries[i].arrives, 5, [=](ErrorStateFilter& f) { (void)f.add(measuredHeight(to, 3.0, 1e-4)); }});
    deliveries.push_back({deliveries[i].arrives, 6, [=](ErrorStateFilter& f) {
                            (void)f.add(measuredAbsolutePose(to, {}, 1e6 * covariance));  // It has no information.
                          }});
  }
  ErrorStateFilter filter(withoutDrag());
  double worst_m = 0;
  feed(filter, imu, deliveries, flight.restUntil(), [&](double t) {
    const auto state = filter.state();
    worst_m = std::max(worst_m, std::abs(state.T_odom_body.position_m.z() - flight.motion.pose(t).position_m.z()));
  });
  EXPECT_GT(filter.counts().heights_gated, 20u);
  EXPECT_EQ(filter.counts().recoveries, 0u);
  EXPECT_LT(worst_m, 0.05);
}

TEST(ErrorStateFilter, AcceptsAMeasurementThatIsRejectedForLongAndReportsIt) {
  SyntheticFlight flight(8, 14.0);
  const auto imu = flight.imuSamples();
  auto deliveries = flight.deliveries();
  for (Delivery& delivery : deliveries) {
    if (delivery.order != 0 || delivery.arrives < Time::fromSeconds(8.0)) continue;
    const double t = delivery.arrives.seconds() - flight.delay_s;
    const Time at = delivery.arrives - Duration::fromSeconds(flight.delay_s);
    const double shifted_m = flight.motion.pose(t).position_m.z() + 0.5;  // The height jumps for good.
    delivery.deliver = [=](ErrorStateFilter& f) { (void)f.add(measuredHeight(at, shifted_m, 1e-4)); };
  }
  ErrorStateFilter filter(withoutDrag());
  bool degraded = false;
  feed(filter, imu, deliveries, flight.restUntil(), [&](double t) {
    if (t > 8.5 && t < 9.0) degraded = degraded || filter.health().status == FusionStatus::kDegraded;
  });
  EXPECT_TRUE(degraded);
  EXPECT_GE(filter.counts().recoveries, 1u);
  EXPECT_LE(filter.counts().recoveries, 3u);
  const auto state = filter.state();
  EXPECT_NEAR(state.T_odom_body.position_m.z(), flight.motion.pose(state.stamp.seconds()).position_m.z() + 0.5, 0.05);
  EXPECT_EQ(filter.health().status, FusionStatus::kOk);
}

TEST(ErrorStateFilter, LastingContradictionIsAPermanentDivergence) {
  SyntheticFlight flight(9, 16.0);
  const auto imu = flight.imuSamples();
  auto deliveries = flight.deliveries();
  for (Delivery& delivery : deliveries) {
    if (delivery.order != 0 || delivery.arrives < Time::fromSeconds(6.0)) continue;
    const Time at = delivery.arrives - Duration::fromSeconds(flight.delay_s);
    const double nonsense_m = std::fmod(delivery.arrives.seconds(), 1.2) > 0.6 ? 5.0 : 0.5;
    delivery.deliver = [=](ErrorStateFilter& f) { (void)f.add(measuredHeight(at, nonsense_m, 1e-4)); };
  }
  ErrorStateFilter filter(withoutDrag());
  feed(filter, imu, deliveries, flight.restUntil());
  EXPECT_EQ(filter.health().status, FusionStatus::kDiverged);
  EXPECT_FALSE(filter.state().horizontal_valid);
  EXPECT_FALSE(filter.state().vertical_valid);
}

TEST(ErrorStateFilter, ASilentLaserDegradesTheStatusUntilScansReturn) {
  SyntheticFlight flight(10, 16.0);
  flight.silent_from_s = 8.0;
  flight.silent_until_s = 9.2;
  flight.reference_every_s = 0.5;
  const auto imu = flight.imuSamples();
  ErrorStateFilter filter(withoutDrag());
  FusionStatus during = FusionStatus::kOk;
  double drift_m = 0;
  feed(filter, imu, flight.deliveries(), flight.restUntil(), [&](double t) {
    if (t < 9.15 || t > 9.16) return;
    during = filter.health().status;
    const auto truth = flight.motion.truth(t);
    drift_m = (filter.state().velocity_odom_m_s - truth.velocity_m_s).norm();
  });
  EXPECT_EQ(during, FusionStatus::kDegraded);
  EXPECT_LT(drift_m, 0.3);
  EXPECT_EQ(filter.health().status, FusionStatus::kOk) << filter.health().reason;
  EXPECT_TRUE(filter.state().horizontal_valid);
}

/// What the filter says after 9.4 s of a flight whose laser measures only until 6 s, or only its heights, and whose
/// camera measures until 8 s.
FusionHealth withoutSensors(bool heights_only) {
  SyntheticFlight flight(10, 9.4);
  flight.camera_hz = 15.0;
  auto deliveries = flight.deliveries();
  std::erase_if(deliveries, [&](const Delivery& d) {
    const bool camera = d.order >= 3, height = d.order == 0;
    if (camera) return d.arrives > Time::fromSeconds(8.0);
    return d.arrives > Time::fromSeconds(6.0) && (height || !heights_only);
  });
  ErrorStateFilter::Config config = withoutDrag();
  config.vertical_timeout_s = config.horizontal_timeout_s;
  ErrorStateFilter filter(config);
  feed(filter, flight.imuSamples(), deliveries, flight.restUntil(), [&](double t) {
    if (t < 7.0 || t > 7.9) return;
    EXPECT_EQ(filter.status(), FusionStatus::kOk) << "the camera replaces the laser";
  });
  return filter.health();
}

TEST(ErrorStateFilter, ItsReasonGivesTheAgeOfTheNewestMeasurementOfLaserAndCamera) {
  EXPECT_THAT(withoutSensors(false).reason, testing::StartsWith("no usable relative pose for 1."));
  EXPECT_THAT(withoutSensors(true).reason, testing::StartsWith("no usable height for 1."));
}

/// Another estimator has weighed the same samples: what the filter knows of the three is replaced, and what is
/// correlated with them follows, as if the difference had been measured.
TEST(ErrorStateFilter, AKnownVerticalStateReplacesItsOwn) {
  SyntheticFlight flight(13, 6.0);
  const auto imu = flight.imuSamples();
  auto deliveries = flight.deliveries();
  const auto silent = Time::fromSeconds(4.0);
  std::erase_if(deliveries, [&](const Delivery& d) { return d.arrives > silent; });
  ErrorStateFilter alone(withoutDrag()), told(withoutDrag());
  feed(alone, imu, deliveries, flight.restUntil());
  const Time at = Time::fromSeconds(5.8);
  const auto before = alone.verticalAt(at);
  ASSERT_TRUE(before);
  VerticalState known{before->height_m + 0.2, before->velocity_m_s - 0.1, before->bias_m_s2 + 0.05, {}};
  known.covariance = Eigen::Vector3d(1e-4, 4e-4, 9e-4).asDiagonal();
  deliveries.push_back(
      {Time::fromSeconds(5.95), 5, [=](ErrorStateFilter& f) { (void)f.add(knownVertical(at, known)); }});
  feed(told, imu, deliveries, flight.restUntil());
  const auto after = told.verticalAt(at);
  ASSERT_TRUE(after);
  EXPECT_NEAR(after->height_m, known.height_m, 0.005);
  EXPECT_NEAR(after->velocity_m_s, known.velocity_m_s, 0.005);
  EXPECT_NEAR(after->bias_m_s2, known.bias_m_s2, 0.002);
  EXPECT_LT((after->covariance - known.covariance).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_FALSE(told.verticalAt(at + Duration::fromSeconds(2.0)));
}

TEST(ErrorStateFilter, TheClimbBetweenTwoTimesIsThatOfTheAccelerometerAlone) {
  SyntheticFlight flight(13, 6.0);
  ErrorStateFilter filter(withoutDrag());
  feed(filter, flight.imuSamples(), flight.deliveries(), flight.restUntil());
  const Time from = Time::fromSeconds(5.3), to = Time::fromSeconds(5.7);
  const auto before = filter.verticalAt(from), after = filter.verticalAt(to, from);
  ASSERT_TRUE(before && after && after->climb);
  const auto& climb = after->climb;
  const double time_s = (to - from).seconds();
  EXPECT_NEAR(before->velocity_m_s + climb->velocity_m_s - before->bias_m_s2 * time_s, after->velocity_m_s, 0.03);
  EXPECT_NEAR(before->height_m + before->velocity_m_s * time_s + climb->height_m, after->height_m, 0.02);
  EXPECT_GT(climb->noise_m_s2_rthz, 0.0);
  EXPECT_FALSE(filter.verticalAt(to, from - Duration::fromSeconds(3.0))->climb);
}

TEST(ErrorStateFilter, InvalidInputIsCountedAndIgnored) {
  SyntheticFlight flight(11, 6.0);
  const auto imu = flight.imuSamples();
  const auto deliveries = flight.deliveries();
  ErrorStateFilter clean({}), dirty({});
  feed(clean, imu, deliveries, flight.restUntil());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t refused = 0;
  feed(dirty, imu, deliveries, flight.restUntil(), [&](double t) {
    if (static_cast<int>(t * 200) % 50 != 0) return;
    const Time now = Time::fromSeconds(t);
    common::ImuSample sample = imu[10];
    dirty.predict(sample);  // Out of order.
    sample.stamps.measured = now + Duration::fromMilliseconds(1);
    sample.specific_force_body_m_s2.x() = nan;
    dirty.predict(sample);
    sample.specific_force_body_m_s2.x() = 0;
    sample.rotation_ahrs_body.coeffs().setZero();
    dirty.predict(sample);
    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
    EXPECT_EQ(dirty.add(measuredHeight(now, nan, 1.0)), Insertion::kInvalid);
    EXPECT_EQ(dirty.add(measuredHeight(now, 1.0, -1.0)), Insertion::kInvalid);
    EXPECT_EQ(dirty.add(knownVertical(now, {nan, 0.0, 0.0, identity})), Insertion::kInvalid);
    EXPECT_EQ(dirty.add(knownVertical(now, {})), Insertion::kInvalid);
    EXPECT_EQ(dirty.add(measuredRelativePose(now, now, {}, identity)), Insertion::kInvalid);
    EXPECT_EQ(dirty.add(measuredRelativePose(now - Duration::fromMilliseconds(7), now, {}, identity)),
              Insertion::kUnknownReference);
    EXPECT_EQ(dirty.add(measuredRelativePose(now - Duration::fromMilliseconds(7), now, {nan, 0, 0}, identity)),
              Insertion::kInvalid);
    EXPECT_EQ(dirty.add(measuredAbsolutePose(now, {}, -identity)), Insertion::kInvalid);
    EXPECT_EQ(dirty.add(measuredHeight(now - Duration::fromSeconds(2.0), 1.0, 1.0)), Insertion::kTooOld);
    EXPECT_EQ(dirty.add(measuredHeight(now + Duration::fromSeconds(2.0), 1.0, 1.0)), Insertion::kTooNew);
    refused += 10;
  });
  EXPECT_EQ(dirty.counts().refused, refused);
  EXPECT_GT(dirty.counts().imu_dropped, 30u);
  expectSameState(clean, dirty, 0.0);
}

TEST(ErrorStateFilter, SurvivesLostImuSamples) {
  SyntheticFlight flight(12, 14.0);
  auto imu = flight.imuSamples();
  common::RandomStream random(1, "loss");
  std::erase_if(imu, [&](const common::ImuSample& s) {
    const double t = s.stamps.measured.seconds();
    return t > 3.0 && (random.chance(0.05) || (t > 8.0 && t < 8.08));
  });
  ErrorStateFilter filter(withoutDrag());
  feed(filter, imu, flight.deliveries(), flight.restUntil());
  const auto state = filter.state();
  const Truth truth = flight.motion.truth(state.stamp.seconds());
  EXPECT_LT((state.velocity_odom_m_s - truth.velocity_m_s).norm(), 0.12);
  EXPECT_EQ(filter.health().status, FusionStatus::kOk) << filter.health().reason;
}

/// Samples from 8 s on that are no better than a prediction: rates off by 17 deg/s, an attitude by 3 deg and the force
/// by 5 % of gravity. Returns the filter after 12 s.
ErrorStateFilter toldPredictions(bool says_so) {
  SyntheticFlight flight(21, 12.0);
  auto imu = flight.imuSamples();
  for (common::ImuSample& sample : imu) {
    const double t = sample.stamps.measured.seconds();
    if (t < 8.0) continue;
    sample.angular_velocity_body_rad_s.z() += 0.3 * std::sin(3.0 * t);
    sample.specific_force_body_m_s2.z() *= 1.05;
    sample.rotation_ahrs_body = common::expSO3({0.05 * std::sin(2.0 * t), 0.05, 0.0}) * sample.rotation_ahrs_body;
  }
  auto deliveries = flight.deliveries();
  if (says_so)
    deliveries.push_back({common::Time::fromSeconds(7.999), 0, [](ErrorStateFilter& f) { f.setPredicted(true); }});
  ErrorStateFilter filter(withoutDrag());
  feed(filter, imu, std::move(deliveries), flight.restUntil());
  return filter;
}

TEST(ErrorStateFilter, PredictedSamplesLeaveTheEstimateToTheLaser) {
  const ErrorStateFilter told = toldPredictions(true), untold = toldPredictions(false);
  const SyntheticFlight flight(21, 12.0);
  const auto state = told.state();
  const Truth truth = flight.motion.truth(state.stamp.seconds());
  EXPECT_LT((state.T_odom_body.position_m - truth.T_odom_body.position_m).norm(), 0.10);
  EXPECT_LT((state.velocity_odom_m_s - truth.velocity_m_s).norm(), 0.25);
  EXPECT_TRUE(state.horizontal_valid);
  EXPECT_EQ(told.health().status, FusionStatus::kOk) << told.health().reason;
  EXPECT_EQ(told.counts().recoveries, 0u);
  EXPECT_GT(untold.counts().recoveries, 0u) << "the predictions of this test are too good to tell";
}

TEST(ErrorStateFilter, TheAhrsCorrectsAWrongTilt) {
  SyntheticFlight flight(15, 16.0);
  auto imu = flight.imuSamples();
  // A knock: the gyroscope reports five degrees of roll that did not happen.
  for (auto& sample : imu) {
    const double t = sample.stamps.measured.seconds();
    if (t > 8.0 && t < 8.1) sample.angular_velocity_body_rad_s.x() += 0.87;
  }
  ErrorStateFilter filter(withoutDrag());
  double late_tilt_rad = 0;
  feed(filter, imu, flight.deliveries(), flight.restUntil(), [&](double t) {
    if (t < 11.0) return;
    const auto slip = filter.state().T_odom_body.rotation * flight.motion.pose(t).rotation.conjugate();
    late_tilt_rad = std::max(late_tilt_rad, common::logSO3(slip).head<2>().norm());
  });
  EXPECT_NE(filter.health().status, FusionStatus::kDiverged);
  EXPECT_LT(late_tilt_rad, 0.03);
  const auto state = filter.state();
  EXPECT_LT((state.velocity_odom_m_s - flight.motion.truth(state.stamp.seconds()).velocity_m_s).norm(), 0.1);
}

/// The AHRS itself is off by 1 deg.
TEST(ErrorStateFilter, AGyroscopeWhoseBiasJumpsIsFoundByTheAhrs) {
  for (const double jump_deg_s : {-8.0, -5.0, 3.0, 5.0, 8.0}) {
    SyntheticFlight flight(15, 14.0);
    auto imu = flight.imuSamples();
    const Eigen::Vector3d jump_rad_s = Eigen::Vector3d::Constant(jump_deg_s * common::kRadPerDeg);
    for (auto& sample : imu)
      if (sample.stamps.measured.seconds() > 8.0) sample.angular_velocity_body_rad_s += jump_rad_s;
    ErrorStateFilter filter(withoutDrag());
    double tilt_rad = 0.0, late_tilt_rad = 0.0;
    feed(filter, imu, flight.deliveries(), flight.restUntil(), [&](double t) {
      const auto slip = filter.state().T_odom_body.rotation * flight.motion.pose(t).rotation.conjugate();
      const double off_rad = common::logSO3(slip).head<2>().norm();
      tilt_rad = std::max(tilt_rad, off_rad);
      if (t > 10.0) late_tilt_rad = std::max(late_tilt_rad, off_rad);
    });
    EXPECT_LT(tilt_rad, 5.0 * common::kRadPerDeg) << jump_deg_s;
    EXPECT_LT(late_tilt_rad, 2.5 * common::kRadPerDeg) << jump_deg_s;
    EXPECT_EQ(filter.counts().recoveries, 0u) << jump_deg_s;
  }
}

/// An autopilot's samples are means over the period before them. Taken as values at their stamps, they would make the
/// attitude late by half a period, which is 3 mrad here.
TEST(ErrorStateFilter, TheAttitudeIsNotLateBySamplesThatAreMeans) {
  const SensorNoise none{0, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, 0, 10.0, 0.01, 0.003, 0.01, 0.01, 0.004};
  SyntheticFlight flight(17, 8.0, none, 3.0);
  auto imu = flight.imuSamples();
  const double period_s = 1.0 / flight.imu_hz;
  for (auto& sample : imu) {
    const double t = sample.stamps.measured.seconds();
    const auto turn = flight.motion.pose(t - period_s).rotation.conjugate() * flight.motion.pose(t).rotation;
    sample.angular_velocity_body_rad_s = common::logSO3(turn) / period_s;
  }
  ErrorStateFilter filter(withoutDrag());
  double greatest_rad = 0.0;
  feed(filter, imu, {}, flight.restUntil(), [&](double t) {
    const double yaw_rad = common::yawOf(filter.state().T_odom_body.rotation);
    const double error_rad = common::wrapAngle(yaw_rad - common::yawOf(flight.motion.pose(t).rotation));
    greatest_rad = std::max(greatest_rad, std::abs(error_rad));
  });
  EXPECT_LT(greatest_rad, 0.001);
}

}  // namespace
}  // namespace swiftlet::perception
