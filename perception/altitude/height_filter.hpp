// Stage 1 of Grzonka 2012, Algorithm 1: the Kalman filter over height and vertical speed (Grzonka 2009, eq. 6 to 8).
// The paper predicts it with the vertical acceleration. Here the fusion filter does, which knows attitude, bias and all
// other sensors, too: its estimate at the time of the scan is the prediction that the beams correct.
#pragma once

#include <Eigen/Core>

#include "common/time.hpp"
#include "perception/altitude/height_measurement.hpp"

namespace swiftlet::perception::altitude {

class HeightFilter {
 public:
  void start(common::Time time, double height_m, double height_variance_m2);
  /// Starts a scan from the fusion filter's estimate at its time.
  void assume(const HeightState& prior);
  void update(double height_m, double variance_m2) { correct(0, height_m, variance_m2); }
  void updateVelocity(double velocity_m_s, double variance_m2_s2) { correct(1, velocity_m_s, variance_m2_s2); }
  /// Variance of the level that the height is measured against. Its error is the same in all updates, so averaging does
  /// not reduce it. It is kept separately from the filter's own covariance and does not affect the gain.
  void setReferenceVariance(double variance_m2) { reference_variance_m2_ = variance_m2; }

  /// Begins the measurement against a level that got its height from this one: the error of the height so far is the
  /// level's, too, and `own_variance_m2` is what the distance between both errs.
  void takeReference(double own_variance_m2);
  /// Ends the measurement against a level: the variance of the reference becomes part of the filter's own.
  void dropReference();

  common::Time stamp() const { return stamp_; }
  double height_m() const { return state_[0]; }
  double velocity_m_s() const { return state_[1]; }
  double referenceVariance_m2() const { return reference_variance_m2_; }
  double ownVariance_m2() const { return covariance_(0, 0); }
  /// Covariance of (height_m, velocity_m_s), including the variance of the reference.
  Eigen::Matrix2d covariance() const;

 private:
  void correct(int component, double value, double variance);

  common::Time stamp_;
  Eigen::Vector2d state_ = Eigen::Vector2d::Zero();       ///< (height_m, velocity_m_s)
  Eigen::Matrix2d covariance_ = Eigen::Matrix2d::Zero();  ///< Of the state, without the variance of the reference.
  double reference_variance_m2_ = 0.0;
};

}  // namespace swiftlet::perception::altitude
