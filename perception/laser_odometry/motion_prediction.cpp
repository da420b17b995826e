#include "perception/laser_odometry/motion_prediction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/config_fields.hpp"
#include "common/square.hpp"

namespace swiftlet::perception {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

using common::kRadPerDeg;
using common::Pose2;
using common::square;

/// Number of steps over which the error of a prediction is averaged.
constexpr double kMemorySteps = 30;
/// Error of position that is expected of the first predictions.
constexpr double kFirstError_m = 0.10;
/// Error of heading that is expected of the first predictions.
constexpr double kFirstError_deg = 5.0;
/// Least error of position that is expected of a prediction, however good the last ones were.
constexpr double kLeastError_m = 0.01;
/// Least error of heading that is expected of a prediction, however good the last ones were.
constexpr double kLeastError_deg = 0.5;
/// Acceleration of a robot that starts or stops: no speed is more certain than this lets it be.
constexpr double kAcceleration_m_s2 = 1.0;

/// The lever arm by which errors of heading are compared with errors of position.
constexpr double kLever_m = 3.0;
/// A single error counts as at most this many sigmas, so that one slip does not widen the search for long.
constexpr double kMaxSurprise = 4.0;
/// The velocity is extrapolated for at most this time: in a longer pause, the robot may as well have stopped.
constexpr double kLongestCoast_s = 2.0;

}  // namespace

void MotionPredictionConfig::describe(common::config::Fields& fields) {
  fields("max_speed_m_s", max_speed_m_s, {0.1, 100},
         "Odometry that claims a greater speed is not believed in that step.");
}

MotionPrediction::MotionPrediction(const MotionPredictionConfig& config) : config_(config) {
  for (Source* source : {&wheels_, &inertia_}) {
    source->variance_m2 = square(kFirstError_m);
    source->variance_rad2 = square(kFirstError_deg * kRadPerDeg);
  }
}

const MotionPrediction::Source& MotionPrediction::best() const {
  const auto cost = [](const Source& s) { return s.variance_m2 + square(kLever_m) * s.variance_rad2; };
  return wheels_.step && cost(wheels_) <= cost(inertia_) ? wheels_ : inertia_;
}

const MotionPrediction::Source* MotionPrediction::other() const {
  const Source& source = &best() == &wheels_ ? inertia_ : wheels_;
  return source.step ? &source : nullptr;
}

double MotionPrediction::sigma_m(const Source& source) const {
  return std::max(std::sqrt(source.variance_m2), kLeastError_m);
}
double MotionPrediction::sigma_rad(const Source& source) const {
  return std::max(std::sqrt(source.variance_rad2), kLeastError_deg * kRadPerDeg);
}
double MotionPrediction::stepSigma_m() const { return sigma_m(best()); }
double MotionPrediction::stepSigma_rad() const { return sigma_rad(best()); }

std::optional<MotionPrediction::Alternative> MotionPrediction::alternative() const {
  const Source* source = other();
  if (source == nullptr) return std::nullopt;
  return Alternative{before_.pose * *source->step, sigma_m(*source), sigma_rad(*source)};
}

void MotionPrediction::takeAlternative() {
  now_.velocity = before_.velocity;
  now_.covariance = before_.covariance;
  follow(*other());
}

void MotionPrediction::predict(const std::optional<Pose2>& T_odom_robot, double elapsed_s) {
  elapsed_s_ = std::max(elapsed_s, 1e-3);
  const std::optional<Pose2> last_odom = std::exchange(T_odom_robot_, T_odom_robot);
  wheels_.step.reset();
  if (last_odom && T_odom_robot) {
    wheels_.step = between(*last_odom, *T_odom_robot);
    if (!(wheels_.step->position_m().norm() <= config_.max_speed_m_s * elapsed_s_)) {
      ++implausible_steps_;
      wheels_.step.reset();
    }
  }
  const Eigen::Vector3d coasted = std::min(elapsed_s_, kLongestCoast_s) * now_.velocity;
  inertia_.step = Pose2{coasted.x(), coasted.y(), coasted.z()};

  before_.pose = now_.pose;
  before_.velocity = now_.velocity;
  before_.covariance = now_.covariance;
  follow(best());
}

void MotionPrediction::follow(const Source& source) {
  const double dt = elapsed_s_;
  const Pose2& step = *source.step;
  now_.pose = before_.pose * step;
  Matrix6d move = Matrix6d::Identity();
  const Eigen::Vector2d moved_m = now_.pose.position_m() - before_.pose.position_m();
  move.block<2, 1>(0, 2) = Eigen::Vector2d(-moved_m.y(), moved_m.x());
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(before_.pose.yaw_rad).toRotationMatrix();
  // The Jacobian of the state by the step.
  Eigen::Matrix<double, 6, 3> by_step;
  by_step << turn, Eigen::Matrix3d::Identity() / dt;
  if (&source == &wheels_) {
    now_.velocity = Eigen::Vector3d(step.x_m, step.y_m, step.yaw_rad) / dt;
    move.bottomRightCorner<3, 3>().setZero();
  } else {
    move.topRightCorner<3, 3>() = turn * dt;
  }
  const double position_m =
      &source == &wheels_ ? sigma_m(source) : std::max(sigma_m(source), kAcceleration_m_s2 * dt * dt);
  const Eigen::Vector3d variances(square(position_m), square(position_m), square(sigma_rad(source)));
  now_.covariance = move * now_.covariance * move.transpose() + by_step * variances.asDiagonal() * by_step.transpose();
}

void MotionPrediction::correct(const Pose2& matched, const Eigen::Matrix3d& covariance,
                               const std::optional<common::UnobservableMotion>& unobservable_motion) {
  const Eigen::Matrix<double, 6, 3> gain =
      now_.covariance.leftCols<3>() * (now_.covariance.topLeftCorner<3, 3>() + covariance).inverse();
  const Eigen::Vector3d off(matched.x_m - now_.pose.x_m, matched.y_m - now_.pose.y_m,
                            common::wrapAngle(matched.yaw_rad - now_.pose.yaw_rad));
  const Eigen::Matrix<double, 6, 1> change = gain * off;
  now_.pose = {now_.pose.x_m + change(0), now_.pose.y_m + change(1), common::wrapAngle(now_.pose.yaw_rad + change(2))};
  now_.velocity += change.tail<3>();
  now_.covariance -= gain * now_.covariance.topRows<3>();
  now_.covariance = 0.5 * (now_.covariance + now_.covariance.transpose()).eval();

  std::optional<common::UnobservableMotion> unobservable_before;
  if (unobservable_motion) unobservable_before = common::turned(*unobservable_motion, -before_.pose.yaw_rad);
  const Pose2 step = between(before_.pose, matched);
  learn(wheels_, step, unobservable_before);
  learn(inertia_, step, unobservable_before);
}

void MotionPrediction::learn(Source& source, const Pose2& step,
                             const std::optional<common::UnobservableMotion>& unobservable) const {
  if (!source.step) return;
  const Eigen::Vector2d off_m = step.position_m() - source.step->position_m();
  Eigen::Vector3d error(off_m.x(), off_m.y(), common::wrapAngle(step.yaw_rad - source.step->yaw_rad));
  double seen_axes = 2.0;
  if (unobservable) {
    const Eigen::RowVector3d share = common::shareAlong(*unobservable);
    seen_axes -= share.head<2>().dot(unobservable->change.head<2>());
    error -= unobservable->change * share.dot(error);
  }
  const double share = 1.0 / kMemorySteps;
  const auto average = [&](double& variance, double error2, double least) {
    const double bounded = std::min(error2, square(kMaxSurprise) * std::max(variance, square(least)));
    variance += share * (bounded - variance);
  };
  average(source.variance_m2, error.head<2>().squaredNorm() / seen_axes, kLeastError_m);
  average(source.variance_rad2, square(error.z()), kLeastError_deg * kRadPerDeg);
}

void MotionPrediction::lose(double sought_m, double sought_rad) {
  now_.velocity *= 0.5;
  if (&best() == &inertia_)
    now_.covariance.diagonal().head<3>() += Eigen::Vector3d(square(sought_m), square(sought_m), square(sought_rad));
  for (int i = 0; i < 2; ++i) now_.covariance(3 + i, 3 + i) += square(stepSigma_m() / elapsed_s_);
  now_.covariance(5, 5) += square(stepSigma_rad() / elapsed_s_);
}

void MotionPrediction::rebase() {
  now_.pose = Pose2{};
  now_.covariance.topRows<3>().setZero();
  now_.covariance.leftCols<3>().setZero();
}

}  // namespace swiftlet::perception
