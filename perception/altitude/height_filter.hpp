// Stage 1 of Grzonka 2012, Algorithm 1: the Kalman filter over height and vertical speed (Grzonka 2009, eq. 6 to 8),
// fed with accelerations that are kept until the late scan that needs them. Beyond the paper it learns the lasting
// error of the acceleration, so that it need not follow every measurement.
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
  /// In place of predictTo(): what somebody who knows more believes at `time`.
  void assume(common::Time time, double height_m, double velocity_m_s, const Eigen::Matrix2d& covariance);
  /// The acceleration between two samples is that of the later one; without samples it is zero.
  void predictTo(common::Time time);
  void update(double height_m, double variance_m2);
  void updateVelocity(double velocity_m_s, double variance_m2_s2);
  /// Back to what was believed some tenths of a second ago, moved on by the accelerations alone: for when the last
  /// updates turn out to have been of something else.
  void recall();
  /// The error of what the height is measured against: the same from update to update, so that averaging does not make
  /// it smaller. It stands beside the filter's own covariance and does not make the filter follow.
  void setReferenceVariance(double variance_m2) { reference_variance_m2_ = variance_m2; }

  /// Nothing is measured against it any more: its error is the filter's own.
  void dropReference();

  common::Time stamp() const { return stamp_; }
  double height_m() const { return now_.state[0]; }
  double velocity_m_s() const { return now_.state[1]; }
  double referenceVariance_m2() const { return reference_variance_m2_; }
  double ownVariance_m2() const { return now_.covariance(0, 0); }
  /// The error of the reference included.
  Eigen::Matrix2d covariance() const;

 private:
  struct Acceleration {
    common::Time stamp;
    double up_m_s2 = 0.0;
  };
  struct Belief {
    common::Time updated;                             ///< Nothing measured later is in it.
    Eigen::Vector3d state = Eigen::Vector3d::Zero();  ///< (height_m, velocity_m_s, error of the acceleration_m_s2)
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
