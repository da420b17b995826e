// Stage 1 of Grzonka 2012, Algorithm 1: the Kalman filter over height and vertical speed (Grzonka 2009, eq. 6 to 8).
// Accelerations are kept until the scan that needs them arrives. Beyond the paper, the filter estimates the bias of the
// acceleration, so that it need not follow every height measurement.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"

namespace swiftlet::perception::altitude {

class HeightFilter {
 public:
  explicit HeightFilter(double acceleration_noise_m_s2);

  void start(common::Time time, double height_m, double height_variance_m2);
  void addAcceleration(common::Time time, double acceleration_up_m_s2);
  /// Replaces the state by the estimate of a better filter at `time`. Call it instead of predictTo().
  void assume(common::Time time, double height_m, double velocity_m_s, const Eigen::Matrix2d& covariance);
  /// Predicts with the accelerations. Between two samples the later one is used; without samples the acceleration is
  /// zero.
  void predictTo(common::Time time);
  void update(double height_m, double variance_m2);
  void updateVelocity(double velocity_m_s, double variance_m2_s2);
  /// Restores the estimate from some tenths of a second ago, predicted to now by the accelerations alone. For use when
  /// the last updates were of a wrong surface.
  void recall();
  /// Variance of the level that the height is measured against. Its error is the same in all updates, so averaging does
  /// not reduce it. It is kept separately from the filter's own covariance and does not affect the gain.
  void setReferenceVariance(double variance_m2) { reference_variance_m2_ = variance_m2; }

  /// Begins the measurement against a level that got its height from this one: the error of the height so far is the
  /// level's, too, and `own_variance_m2` is what the distance between both errs.
  void takeReference(double own_variance_m2);
  /// Ends the measurement against a level: the variance of the reference becomes part of the filter's own.
  void dropReference();

  common::Time stamp() const { return stamp_; }
  double height_m() const { return now_.state[0]; }
  double velocity_m_s() const { return now_.state[1]; }
  double referenceVariance_m2() const { return reference_variance_m2_; }
  double ownVariance_m2() const { return now_.covariance(0, 0); }
  /// Covariance of (height_m, velocity_m_s), including the variance of the reference.
  Eigen::Matrix2d covariance() const;

 private:
  struct Acceleration {
    common::Time stamp;
    double up_m_s2 = 0.0;
  };
  struct Belief {
    common::Time updated;                             ///< Time of the last measurement included.
    Eigen::Vector3d state = Eigen::Vector3d::Zero();  ///< (height_m, velocity_m_s, acceleration_bias_m_s2)
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };
  void predict(double dt_s, double acceleration_up_m_s2);
  void correct(int component, double value, double variance);

  double acceleration_noise_m_s2_;
  common::Time stamp_;
  Belief now_, before_, long_before_;
  double reference_variance_m2_ = 0.0;
  std::vector<Acceleration> ring_;
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace swiftlet::perception::altitude
