// Stage 1 of Grzonka 2012, Algorithm 1: the Kalman filter over height and vertical speed (Grzonka 2009, eq. 6 to 8),
// fed with accelerations that are kept until the late scan that needs them.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"

namespace swiftlet::perception::altitude {

class HeightFilter {
 public:
  HeightFilter(double acceleration_noise_m_s2, double max_prediction_s);

  void start(common::Time time, double height_m, double height_variance_m2);
  void addAcceleration(common::Time time, double acceleration_up_m_s2);
  /// The acceleration between two samples is that of the later one; without samples it is zero.
  void predictTo(common::Time time);
  /// Returns the innovation's variance.
  double update(double height_m, double variance_m2);
  void keepVarianceAbove(double variance_m2);

  common::Time stamp() const { return stamp_; }
  double height_m() const { return state_[0]; }
  double velocity_m_s() const { return state_[1]; }
  const Eigen::Matrix2d& covariance() const { return covariance_; }

 private:
  struct Acceleration {
    common::Time stamp;
    double up_m_s2 = 0.0;
  };
  void predict(double dt_s, double acceleration_up_m_s2);

  double acceleration_noise_m_s2_, max_prediction_s_;
  common::Time stamp_;
  Eigen::Vector2d state_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_ = Eigen::Matrix2d::Zero();
  std::vector<Acceleration> ring_;
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace swiftlet::perception::altitude
