// The error-state filter when no scan observes the motion: the guess, the drag, a given pose.
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/fusion/synthetic_flight.hpp"

namespace swiftlet::perception {
namespace {

using common::Duration;
using common::Time;

/// In a corridor a matcher returns the guess. Used as a measurement, repeatedly, it would make an unobserved motion
/// certain.
TEST(ErrorStateFilter, IgnoresAMeasurementInItsUnobservableDirection) {
  const Time from = Time::fromSeconds(0.7);
  const auto fly = [&](double along_m, bool unseen) {
    ErrorStateFilter filter({});
    for (int i = 0; i <= 2000; ++i) {
      common::ImuSample sample;
      sample.stamps.measured = sample.stamps.arrived = Time::fromSeconds(0.005 * i);
      sample.specific_force_body_m_s2 = {0.0, 0.0, 9.81};
      filter.predict(sample);
      if (i == 130) {
        EXPECT_TRUE(filter.initialize(0.15));
      }
      if (i == 150) {
        EXPECT_EQ(filter.add(poseClone(from)), Insertion::kTaken);
      }
      if (i <= 150 || i % 20 != 0) continue;
      const Eigen::Matrix3d covariance = Eigen::Vector3d(1.0, 1e-4, 1e-6).asDiagonal();
      const auto direction = unseen ? std::optional(common::UnobservableMotion{}) : std::nullopt;
      EXPECT_EQ(
          filter.add(measuredRelativePose(from, sample.stamps.measured, {along_m, 0.0, 0.0}, covariance, direction)),
          Insertion::kTaken);
    }
    return filter.state();
  };
  const auto right = fly(0.0, true), wrong = fly(3.0, true), believed = fly(0.0, false);
  EXPECT_EQ(right.T_odom_body.position_m, wrong.T_odom_body.position_m);
  EXPECT_EQ(right.position_covariance_m2, wrong.position_covariance_m2);
  EXPECT_LT(right.position_covariance_m2(1, 1), 1e-3);
  EXPECT_GT(right.position_covariance_m2(0, 0), 2.0 * believed.position_covariance_m2(0, 0));
  EXPECT_TRUE(right.horizontal_valid);
}

/// In a round room a matcher returns the guess of the turn about its middle, here 1 m to the left. Where the vehicle is
/// between the middle and the wall is measured all the same.
TEST(ErrorStateFilter, IgnoresATurnThatIsNotObservable) {
  const Time from = Time::fromSeconds(0.7);
  const auto fly = [&](double turned_rad, double nearer_m) {
    ErrorStateFilter filter({});
    for (int i = 0; i <= 2000; ++i) {
      common::ImuSample sample;
      sample.stamps.measured = sample.stamps.arrived = Time::fromSeconds(0.005 * i);
      sample.specific_force_body_m_s2 = {0.0, 0.0, 9.81};
      filter.predict(sample);
      if (i == 130) {
        EXPECT_TRUE(filter.initialize(0.15));
      }
      if (i == 150) {
        EXPECT_EQ(filter.add(poseClone(from)), Insertion::kTaken);
      }
      if (i <= 150 || i % 20 != 0) continue;
      // About (0, 1): the body at the origin moves along x.
      const common::UnobservableMotion turn{{1.0, 0.0, 1.0}, 3.0};
      const common::Pose2 pose{turned_rad, nearer_m, turned_rad};
      EXPECT_EQ(filter.add(
                    measuredRelativePose(from, sample.stamps.measured, pose, 1e-4 * Eigen::Matrix3d::Identity(), turn)),
                Insertion::kTaken);
    }
    return filter.state();
  };
  const auto still = fly(0.0, 0.0), turned = fly(0.3, 0.0), nearer = fly(0.0, 0.05);
  EXPECT_LT((still.T_odom_body.position_m - turned.T_odom_body.position_m).norm(), 1e-6);
  EXPECT_LT(still.T_odom_body.rotation.angularDistance(turned.T_odom_body.rotation), 1e-6);
  EXPECT_NEAR(nearer.T_odom_body.position_m.y(), 0.05, 0.01);
}

/// The gyroscopes drift by 0.3 deg/s more than they did at rest, and no scan shows the heading; the AHRS, which has an
/// offset of its own, drifts by 0.05 deg/s.
TEST(ErrorStateFilter, TheAhrsKeepsAHeadingThatNoScanShows) {
  const auto headingAfter_deg = [](double seconds, bool use_ahrs) {
    ErrorStateFilter::Config config;
    config.use_ahrs = use_ahrs;
    ErrorStateFilter filter(config);
    for (int i = 0; i <= std::lround(200 * seconds); ++i) {
      const double t = 0.005 * i;
      common::ImuSample sample;
      sample.stamps.measured = sample.stamps.arrived = Time::fromSeconds(t);
      sample.specific_force_body_m_s2 = {0.0, 0.0, 9.81};
      sample.angular_velocity_body_rad_s.z() = (i > 200 ? 0.3 : 0.0) * common::kRadPerDeg;
      sample.rotation_ahrs_body = common::quaternionFrom({0.0, 0.0, 2.0 + 0.05 * common::kRadPerDeg * t});
      filter.predict(sample);
      if (i == 130) {
        EXPECT_TRUE(filter.initialize(0.15));
      }
    }
    return common::yawOf(filter.state().T_odom_body.rotation) / common::kRadPerDeg;
  };
  EXPECT_GT(headingAfter_deg(60.0, false), 15.0) << "by the gyroscopes alone";
  EXPECT_LT(std::abs(headingAfter_deg(60.0, true)), 10.0) << "of which the AHRS drifts by 3";
}

/// 20 s at 0.7 m/s, of which the laser observes the first six: the drag learned there holds the speed afterwards. The
/// accelerometer has an unknown bias.
TEST(ErrorStateFilter, DragBoundsTheErrorOfAnUnobservedSpeed) {
  constexpr double kDrag_1_s = 0.18, kBias_m_s2 = 0.06, kSpeed_m_s = 0.7, kStart_s = 3.0, kSeen_s = 9.0;
  const auto speedAt = [&](double t) { return std::clamp(0.7 * (t - kStart_s), 0.0, kSpeed_m_s); };
  const auto errorAtEnd = [&](bool use_drag) {
    ErrorStateFilter::Config config;
    config.use_drag = use_drag;
    ErrorStateFilter filter(config);
    common::RandomStream random(5, "drag");
    double x_m = 0.0, learned_1_s = 0.0;
    Time reference;
    double reference_x_m = 0.0;
    for (int i = 0; i <= 4600; ++i) {
      const double t = 0.005 * i, speed = speedAt(t), acceleration = (speedAt(t + 0.005) - speed) / 0.005;
      // The vehicle tilts just as far as drag and acceleration require.
      const double lean_rad = std::asin((acceleration + kDrag_1_s * speed) / 9.81);
      const double lean_after_rad =
          std::asin(((speedAt(t + 0.01) - speedAt(t + 0.005)) / 0.005 + kDrag_1_s * speedAt(t + 0.005)) / 9.81);
      common::ImuSample sample;
      sample.stamps.measured = sample.stamps.arrived = Time::fromSeconds(t);
      sample.rotation_ahrs_body = common::quaternionFrom({0.0, lean_rad, 0.0});
      sample.angular_velocity_body_rad_s = {0.0, (lean_after_rad - lean_rad) / 0.005, 0.0};
      sample.specific_force_body_m_s2 = {kBias_m_s2 - kDrag_1_s * speed + random.gaussian(0.08), random.gaussian(0.08),
                                         9.81 * std::cos(lean_rad) + random.gaussian(0.08)};
      filter.setAtRest(t < 1.0);
      filter.predict(sample);
      if (i == 130) {
        EXPECT_TRUE(filter.initialize(0.15));
      }
      if (i >= 150 && i % 20 == 0) {
        if (i > 150 && t <= kSeen_s)
          (void)filter.add(measuredRelativePose(reference, sample.stamps.measured,
                                                {x_m - reference_x_m + random.gaussian(0.004), 0.0, 0.0},
                                                Eigen::Vector3d(2e-5, 2e-5, 1e-5).asDiagonal()));
        else if (i > 150)
          (void)filter.add(measuredRelativePose(reference, sample.stamps.measured, {},
                                                Eigen::Vector3d(1, 2e-5, 1e-5).asDiagonal(),
                                                common::UnobservableMotion{}));
        (void)filter.add(measuredHeight(sample.stamps.measured, 0.15, 1e-4));
        if (i % 100 == 0 || reference == Time{}) {
          (void)filter.add(poseClone(sample.stamps.measured));
          reference = sample.stamps.measured;
          reference_x_m = x_m;
        }
      }
      if (t < kSeen_s) learned_1_s = filter.estimate().drag_1_s;
      x_m += 0.005 * 0.5 * (speed + speedAt(t + 0.005));
    }
    if (use_drag) {
      EXPECT_NEAR(learned_1_s, kDrag_1_s, 0.05);
    }
    return std::abs(filter.state().T_odom_body.position_m.x() - x_m);
  };
  const double with_drag_m = errorAtEnd(true), without_m = errorAtEnd(false);
  std::printf("14 s unseen at 0.7 m/s: %.2f m off with the drag, %.2f m without\n", with_drag_m, without_m);
  EXPECT_LT(with_drag_m, 0.8);
  EXPECT_LT(with_drag_m, 0.5 * without_m);
}

TEST(ErrorStateFilter, AbsolutePosesRemoveDrift) {
  SyntheticFlight flight(14, 20.0);
  flight.reference_every_s = 0.05;  // Much drift.
  const auto imu = flight.imuSamples();
  auto deliveries = flight.deliveries();
  for (double t = 8.0; t < 20.0; t += 1.0) {
    const auto pose = planar(flight.motion.pose(t));
    const Time at = Time::fromSeconds(t);
    deliveries.push_back({at + Duration::fromSeconds(0.3), 9, [=](ErrorStateFilter& f) {
                            EXPECT_EQ(f.add(measuredAbsolutePose(at, pose, 1e-4 * Eigen::Matrix3d::Identity())),
                                      Insertion::kTaken);
                          }});
  }
  ErrorStateFilter filter(withoutDrag());
  feed(filter, imu, deliveries, flight.restUntil());
  const auto state = filter.state();
  const Truth truth = flight.motion.truth(state.stamp.seconds());
  EXPECT_LT((state.T_odom_body.position_m - truth.T_odom_body.position_m).norm(), 0.08);
}

}  // namespace
}  // namespace swiftlet::perception
