// Laws of the filter's models: every Jacobian is the derivative of its function; clones are copies.
#include <gtest/gtest.h>

#include "common/random.hpp"
#include "perception/fusion/imu_model.hpp"
#include "perception/fusion/measurement_models.hpp"

namespace swiftlet::perception::fusion {
namespace {

Eigen::Vector3d vector(common::RandomStream& random, double scale) {
  const double x = random.gaussian(scale), y = random.gaussian(scale), z = random.gaussian(scale);
  return {x, y, z};
}

FilterState randomState(common::RandomStream& random, int clones) {
  FilterState state;
  const auto move = [&] {
    state.position_odom_m = vector(random, 3.0);
    state.rotation_odom_body =
        common::quaternionFrom({random.gaussian(0.2), random.gaussian(0.2), random.uniform(-3.1, 3.1)});
  };
  Eigen::Matrix<double, kCore, kCore> a;
  for (int i = 0; i < a.size(); ++i) a(i) = random.gaussian(0.1);
  state.covariance = a * a.transpose();
  for (double& by_laser : state.by_laser.reshaped()) by_laser = random.gaussian(0.5);
  for (int i = 0; i < clones; ++i) {
    move();
    state.stamp = common::Time::fromSeconds(0.1 * i);
    state.velocity_odom_m_s = vector(random, 1.0);
    state.yaw_rate_odom_rad_s = random.gaussian(1.0);
    state.clonePose(OdometrySource::kLaser);
  }
  move();
  state.stamp = common::Time::fromSeconds(1.0);
  state.velocity_odom_m_s = vector(random, 1.0);
  state.accelerometer_bias_m_s2 = vector(random, 0.1);
  state.gyroscope_bias_rad_s = vector(random, 0.02);
  state.drag_1_s = random.uniform(0.1, 0.5);
  state.wind_odom_m_s = vector(random, 0.3).head<2>();
  state.yaw_rate_odom_rad_s = random.gaussian(1.0);
  return state;
}

/// Moves the state by one error; the residual must fall by H times it.
template <int K, typename Model>
void expectJacobian(const FilterState& state, const Model& model) {
  const Linearized<K> at = model(state);
  constexpr double h = 1e-6;
  for (int column = 0; column < state.dimension(); ++column) {
    const auto residualAt = [&](double step) {
      FilterState moved = state;
      ErrorVector error = ErrorVector::Zero(state.dimension());
      error(column) = step;
      moved.inject(error);
      return model(moved).residual;
    };
    const Eigen::Matrix<double, K, 1> numeric = -(residualAt(h) - residualAt(-h)) / (2 * h);
    for (int row = 0; row < K; ++row)
      EXPECT_NEAR(at.jacobian(row, column), numeric(row), 2e-6) << "row " << row << " column " << column;
  }
}

class Jacobians : public testing::TestWithParam<int> {
 protected:
  common::RandomStream random{static_cast<std::uint64_t>(GetParam()), "jacobians"};
  FilterState state = randomState(random, 3);
};

TEST_P(Jacobians, RelativePoseIsTheNumericDerivative) {
  expectJacobian<3>(state, [](const FilterState& s) {
    return relativePose(s, 1, {0.3, -0.2, 0.1}, Eigen::Matrix3d::Identity());
  });
}
/// What a laser measures that is mounted askew and whose clock is off.
TEST_P(Jacobians, RelativePoseByTheErrorsOfTheLaserIsTheNumericDerivative) {
  const ClonedPose& from = state.clones[1];
  const auto later = [](const common::Pose3& pose, const Eigen::Vector3d& velocity_m_s, double rate_rad_s,
                        double by_s) {
    common::Pose2 moved = planar(pose);
    moved.x_m += by_s * velocity_m_s.x();
    moved.y_m += by_s * velocity_m_s.y();
    moved.yaw_rad += by_s * rate_rad_s;
    return moved;
  };
  const auto measured = [&](const Eigen::Vector4d& off) {
    const common::Pose2 mount{off[1], off[2], off[0]};
    const common::Pose2 T_odom_from = later(from.T_odom_body, from.velocity_odom_m_s, from.yaw_rate_odom_rad_s, off[3]);
    const common::Pose2 T_odom_to = later({state.rotation_odom_body, state.position_odom_m}, state.velocity_odom_m_s,
                                          state.yaw_rate_odom_rad_s, off[3]);
    return mount.inverse() * (T_odom_from.inverse() * T_odom_to) * mount;
  };
  const auto by_laser = relativePose(state, 1, measured(Eigen::Vector4d::Zero()), Eigen::Matrix3d::Identity()).by_laser;
  constexpr double h = 1e-6;
  for (int column = 0; column < kLaserSize; ++column) {
    const Eigen::Vector4d step = h * Eigen::Vector4d::Unit(column);
    const Eigen::Vector3d numeric = (relativePose(state, 1, measured(step), Eigen::Matrix3d::Identity()).residual -
                                     relativePose(state, 1, measured(-step), Eigen::Matrix3d::Identity()).residual) /
                                    (2 * h);
    EXPECT_LT((by_laser.col(column) - numeric).cwiseAbs().maxCoeff(), 2e-6) << "column " << column;
  }
}
TEST_P(Jacobians, RelativePoseAcrossIsTheNumericDerivative) {
  expectJacobian<2>(state, [](const FilterState& s) {
    return relativePoseAcross(s, 1, {0.3, -0.2, 0.1}, Eigen::Matrix3d::Identity(), {{0.6, 0.8, 0.3}, 2.0});
  });
}
/// At the pose that the state predicts: elsewhere the error of a rotation is not linear.
TEST_P(Jacobians, RelativePose3IsTheNumericDerivative) {
  const common::Pose3 T_clone_body =
      state.clones[1].T_odom_body.inverse() * common::Pose3{state.rotation_odom_body, state.position_odom_m};
  expectJacobian<6>(state, [&](const FilterState& s) {
    return relativePose3(s, 1, T_clone_body, Eigen::Matrix<double, 6, 6>::Identity());
  });
}
/// The mean velocity of the drag interval equals the state's velocity, as after each step.
TEST_P(Jacobians, DragIsTheNumericDerivative) {
  expectJacobian<2>(state, [](FilterState s) {
    s.drag_stretch.seconds = 0.1;
    s.drag_stretch.force_sum_m_s = {0.02, -0.01};
    s.drag_stretch.velocity_sum_m = 0.1 * (s.rotation_odom_body.conjugate() * s.velocity_odom_m_s).head<2>();
    return drag(s, 0.01);
  });
}
TEST_P(Jacobians, HeightIsTheNumericDerivative) {
  expectJacobian<1>(state, [](const FilterState& s) { return height(s, 1.0, 0.01); });
}
TEST_P(Jacobians, AbsolutePoseIsTheNumericDerivative) {
  expectJacobian<3>(state, [](const FilterState& s) {
    return absolutePose(s, {1.0, 2.0, 0.5}, Eigen::Matrix3d::Identity());
  });
}
TEST_P(Jacobians, AhrsYawIsTheNumericDerivative) {
  expectJacobian<1>(state, [](const FilterState& s) { return ahrsYaw(s, 0.4, 0.01); });
}
TEST_P(Jacobians, GravityIsTheNumericDerivative) {
  expectJacobian<3>(state, [](const FilterState& s) { return gravity(s, {0.1, -0.2, 9.7}, 9.81, 1.0); });
}
TEST_P(Jacobians, ZeroVelocityIsTheNumericDerivative) {
  expectJacobian<3>(state, [](const FilterState& s) { return zeroVelocity(s, 0.01); });
}
TEST_P(Jacobians, ZeroRotationIsTheNumericDerivative) {
  expectJacobian<3>(state, [](const FilterState& s) { return zeroRotation(s, {0.01, 0.02, 0.03}, 0.01); });
}
TEST_P(Jacobians, UpDirectionIsTheNumericDerivative) {
  // Linearized where the measured direction is nearly the estimated one: the sine of a small angle.
  const Eigen::Vector3d up = state.rotation_odom_body.conjugate() * Eigen::Vector3d::UnitZ();
  expectJacobian<2>(state, [&](const FilterState& s) { return upDirection(s, up, 0.01); });
}

TEST_P(Jacobians, StrapdownStepIsTheNumericDerivative) {
  ImuValue begin{state.stamp, vector(random, 0.5), Eigen::Vector3d(0, 0, 9.81) + vector(random, 1.0)};
  ImuValue end{state.stamp + common::Duration::fromMilliseconds(5), vector(random, 0.5),
               Eigen::Vector3d(0, 0, 9.81) + vector(random, 1.0)};
  const auto f = transition(state, begin, end);
  const auto step = [&](int column, double h) {
    FilterState moved = state;
    ErrorVector error = ErrorVector::Zero(state.dimension());
    error(column) = h;
    moved.inject(error);
    propagate(moved, begin, end, {});
    return moved;
  };
  constexpr double h = 1e-5;
  for (int column = 0; column < kCore; ++column) {
    const FilterState plus = step(column, h), minus = step(column, -h);
    Eigen::Matrix<double, kCore, 1> numeric;
    numeric << plus.position_odom_m - minus.position_odom_m, plus.velocity_odom_m_s - minus.velocity_odom_m_s,
        common::logSO3(plus.rotation_odom_body * minus.rotation_odom_body.conjugate()),
        plus.accelerometer_bias_m_s2 - minus.accelerometer_bias_m_s2,
        plus.gyroscope_bias_rad_s - minus.gyroscope_bias_rad_s, plus.drag_1_s - minus.drag_1_s,
        plus.wind_odom_m_s - minus.wind_odom_m_s, plus.ahrs_yaw_off - minus.ahrs_yaw_off;
    numeric /= 2 * h;
    // Position by gyroscope is of third order in the step and left out: 1e-6 at 5 ms.
    EXPECT_LT((f.col(column) - numeric).cwiseAbs().maxCoeff(), 5e-6) << "column " << column;
  }
}

TEST_P(Jacobians, PropagatingTheCovarianceIsFPFt) {
  ImuValue begin{state.stamp, vector(random, 0.5), Eigen::Vector3d(0, 0, 9.81)};
  ImuValue end{state.stamp + common::Duration::fromMilliseconds(5), vector(random, 0.5), Eigen::Vector3d(0, 0, 9.81)};
  Eigen::MatrixXd f = Eigen::MatrixXd::Identity(state.dimension(), state.dimension());
  f.topLeftCorner<kCore, kCore>() = transition(state, begin, end);
  const Eigen::MatrixXd expected = f * state.covariance * f.transpose(), by_laser = f * state.by_laser;
  propagate(state, begin, end, {});
  EXPECT_LT((state.by_laser - by_laser).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((state.covariance - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(Jacobians, UpdateIsTheTextbookUpdate) {
  const auto m = relativePose(state, 2, {0.3, -0.2, 0.1}, 0.01 * Eigen::Matrix3d::Identity());
  const int n = state.dimension();
  const Eigen::MatrixXd h = m.jacobian.leftCols(n), p = state.covariance;
  const Eigen::MatrixXd k = p * h.transpose() * (h * p * h.transpose() + m.noise).inverse();
  const Eigen::MatrixXd joseph =
      (Eigen::MatrixXd::Identity(n, n) - k * h) * p * (Eigen::MatrixXd::Identity(n, n) - k * h).transpose() +
      k * m.noise * k.transpose();
  FilterState expected = state;
  expected.inject(k * m.residual);
  // What an error of the laser adds to a measurement, the gain takes into the estimate.
  const Eigen::MatrixXd by_laser = state.by_laser - k * (h * state.by_laser + m.by_laser);
  ASSERT_TRUE(update(state, m));
  EXPECT_LT((state.covariance - joseph).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((state.by_laser - by_laser).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((state.position_odom_m - expected.position_odom_m).norm(), 1e-10);
  EXPECT_LT(state.rotation_odom_body.angularDistance(expected.rotation_odom_body), 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Jacobians, testing::Range(1, 9));

TEST(Clones, ACloneHasTheCovariancesOfItsPose) {
  common::RandomStream random(3, "clones");
  FilterState state = randomState(random, 2);
  state.clonePose(OdometrySource::kVision);
  const int n = state.dimension(), at = n - kCloneSize;
  const auto pose = [&](int row) { return row < 3 ? kPosition + row : kAttitude + row - 3; };
  for (int i = 0; i < kCloneSize; ++i)
    for (int j = 0; j < n; ++j) {
      EXPECT_EQ(state.covariance(at + i, j), state.covariance(pose(i), j));
      EXPECT_EQ(state.covariance(j, at + i), state.covariance(j, pose(i)));
    }
  for (int i = 0; i < kCloneSize; ++i) EXPECT_EQ(state.by_laser.row(at + i), state.by_laser.row(pose(i)));
  state.clonePose(OdometrySource::kVision);  // The same instant again: nothing new.
  EXPECT_EQ(state.dimension(), n);
}

/// The times of the clones in tenths of a second.
std::vector<int> tenthsOf(const FilterState& state, OdometrySource source) {
  std::vector<int> tenths;
  for (int i = 0; i < state.clone_count; ++i)
    if (const ClonedPose& clone = state.clones[static_cast<std::size_t>(i)]; clone.source == source)
      tenths.push_back(static_cast<int>(std::lround(10.0 * clone.stamp.seconds())));
  return tenths;
}

TEST(Clones, ANewOneReplacesTheOldestOfItsOwnSensor) {
  constexpr auto kLaser = OdometrySource::kLaser, kVision = OdometrySource::kVision;
  common::RandomStream random(4, "clones");
  FilterState state = randomState(random, kMaxClones);
  const ErrorCovariance before = state.covariance;
  const LaserSensitivity by_laser_before = state.by_laser;
  state.clonePose(kLaser);
  EXPECT_EQ(tenthsOf(state, kLaser), (std::vector{1, 2, 3, 10})) << "alone it has all";
  const int third = kCore + 2 * kCloneSize, second = kCore + kCloneSize;
  EXPECT_EQ(state.covariance(second, second), before(third, third));
  EXPECT_EQ(state.covariance(second, 2), before(third, 2));
  EXPECT_EQ(state.by_laser.row(second), by_laser_before.row(third));

  for (int tenth = 11; tenth <= 16; ++tenth) {
    state.stamp = common::Time::fromSeconds(0.1 * tenth);
    state.clonePose(kVision);
  }
  EXPECT_EQ(tenthsOf(state, kLaser), std::vector{10}) << "a laser that is not used keeps its reference";
  EXPECT_EQ(tenthsOf(state, kVision), (std::vector{14, 15, 16}));
  state.stamp = common::Time::fromSeconds(1.7);
  state.clonePose(kLaser);
  EXPECT_EQ(tenthsOf(state, kLaser), std::vector{17});
  EXPECT_EQ(tenthsOf(state, kVision), (std::vector{14, 15, 16}));
}

}  // namespace
}  // namespace swiftlet::perception::fusion
