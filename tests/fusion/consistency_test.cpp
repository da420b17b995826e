// Whether the filter's errors agree with its covariance, with and without a camera, and what the camera does for it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fusion/synthetic_flight.hpp"

namespace swiftlet::perception {
namespace {

using common::Time;

/// NEES for each degree of freedom over many flights.
void expectConsistent(double camera_hz) {
  constexpr int kRuns = 24;
  double nees_sum = 0;
  double velocity2 = 0, tilt2 = 0;
  int samples = 0;
  const std::vector<int> rows = {2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14};
  for (int run = 0; run < kRuns; ++run) {
    common::RandomStream random(static_cast<std::uint64_t>(run), "bias");
    SensorNoise noise;
    noise.accelerometer_bias = {random.gaussian(0.1), random.gaussian(0.1), random.gaussian(0.1)};
    SyntheticFlight flight(static_cast<std::uint64_t>(100 + run), 16.0, noise);
    flight.camera_hz = camera_hz;
    const auto imu = flight.imuSamples();
    const Eigen::Vector3d accelerometer_bias = flight.accelerometer_bias, gyroscope_bias = flight.gyroscope_bias;
    ErrorStateFilter::Config config = withoutDrag();
    config.accelerometer_bias_sigma_m_s2 = 0.1;
    ErrorStateFilter filter(config);
    feed(filter, imu, flight.deliveries(), flight.restUntil());
    const auto state = filter.state();
    const Truth truth = flight.motion.truth(state.stamp.seconds());
    Eigen::Matrix<double, 15, 1> error;
    error << truth.T_odom_body.position_m - state.T_odom_body.position_m, truth.velocity_m_s - state.velocity_odom_m_s,
        common::logSO3(truth.T_odom_body.rotation * state.T_odom_body.rotation.conjugate()),
        accelerometer_bias - filter.estimate().accelerometer_bias_m_s2,
        gyroscope_bias - filter.estimate().gyroscope_bias_rad_s;
    const auto covariance = filter.estimate().covariance;
    const auto n = static_cast<Eigen::Index>(rows.size());
    Eigen::VectorXd e(n);
    Eigen::MatrixXd p(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      e(i) = error(rows[static_cast<std::size_t>(i)]);
      for (Eigen::Index j = 0; j < n; ++j)
        p(i, j) = covariance(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]);
    }
    // The attitude error in odom depends on the (drifting) yaw only in the second order.
    nees_sum += e.dot(p.ldlt().solve(e));
    velocity2 += error.segment<3>(3).squaredNorm() / 3;
    tilt2 += error.segment<2>(6).squaredNorm() / 2;
    ++samples;
  }
  const double nees = nees_sum / (kRuns * static_cast<double>(rows.size()));
  std::printf("consistency: NEES %.2f per degree of freedom over %d runs, velocity %.4f m/s, tilt %.3f deg RMS\n", nees,
              kRuns, std::sqrt(velocity2 / samples), std::sqrt(tilt2 / samples) * 57.3);
  // 24 runs of 12 degrees of freedom: one standard deviation of the mean is 0.08.
  EXPECT_GT(nees, 0.6);
  EXPECT_LT(nees, 1.35);
  EXPECT_LT(std::sqrt(velocity2 / samples), 0.025);
  EXPECT_LT(std::sqrt(tilt2 / samples), 0.01);
}

TEST(ErrorStateFilter, ItsErrorsAgreeWithItsCovariance) { expectConsistent(0.0); }

TEST(ErrorStateFilter, ItsErrorsAgreeWithItsCovarianceWithACameraToo) { expectConsistent(15.0); }

/// The laser is blind for 5 s in mid-flight. Without the camera the position is lost.
TEST(ErrorStateFilter, ACameraCarriesTheStateWhileTheLaserIsBlind) {
  for (const double camera_hz : {15.0, 0.0}) {
    SyntheticFlight flight(31, 14.0);
    flight.camera_hz = camera_hz;
    flight.silent_from_s = 7.0;
    flight.silent_until_s = 12.0;
    ErrorStateFilter filter(withoutDrag());
    bool valid = true;
    double greatest_m = 0.0;
    feed(filter, flight.imuSamples(), flight.deliveries(), flight.restUntil(), [&](double t) {
      if (t < 7.2 || t > 12.0) return;
      const auto state = filter.state();
      valid = valid && state.horizontal_valid && state.vertical_valid;
      const Truth truth = flight.motion.truth(state.stamp.seconds());
      greatest_m = std::max(greatest_m, (truth.T_odom_body.position_m - state.T_odom_body.position_m).norm());
    });
    EXPECT_EQ(valid, camera_hz > 0.0);
    if (camera_hz > 0.0) {
      EXPECT_LT(greatest_m, 0.12);
    }
    EXPECT_NE(filter.health().status, FusionStatus::kDiverged);
  }
}

TEST(ErrorStateFilter, AWrongCameraDoesNotMoveItWhileTheLaserSees) {
  SyntheticFlight flight(32, 10.0);
  const auto imu = flight.imuSamples();
  auto deliveries = flight.deliveries();
  // From 6 s on a camera claims that the vehicle moves a metre to the side.
  const Time from = Time::fromSeconds(6.0), to = Time::fromSeconds(7.0);
  deliveries.push_back({from, 3, [=](ErrorStateFilter& f) { (void)f.add(poseClone(from)); }});
  const common::Pose3 wrong{Eigen::Quaterniond::Identity(), {0.0, 1.5, 0.0}};
  deliveries.push_back({to, 3, [=](ErrorStateFilter& f) {
                          (void)f.add(
                              measuredRelativePose3(from, to, wrong, 1e-4 * Eigen::Matrix<double, 6, 6>::Identity()));
                        }});
  ErrorStateFilter with(withoutDrag()), without(withoutDrag());
  feed(with, imu, deliveries, flight.restUntil());
  feed(without, imu, flight.deliveries(), flight.restUntil());
  EXPECT_LT((with.state().T_odom_body.position_m - without.state().T_odom_body.position_m).norm(), 0.05);
}

}  // namespace
}  // namespace swiftlet::perception
