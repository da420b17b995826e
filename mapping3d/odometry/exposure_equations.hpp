// The normal equations of an alignment: six unknowns of the pose, and gain and offset of the exposure.
#pragma once

#include <Eigen/Core>

namespace swiftlet::mapping3d {

/// The step of the pose is in the camera's axes: translation, then rotation vector.
class ExposureEquations {
 public:
  using Vector8d = Eigen::Matrix<double, 8, 1>;
  using Matrix8d = Eigen::Matrix<double, 8, 8>;

  ExposureEquations() { matrix_.setZero(), right_.setZero(); }

  void addGray(const Vector8d& jacobian, double residual, double weight) {
    for (int column = 0; column < 8; ++column) {
      const double weighted = weight * jacobian[column];
      for (int row = column; row < 8; ++row) matrix_(row, column) += weighted * jacobian[row];
      right_[column] -= weighted * residual;
    }
  }
  /// `jacobian` has the six unknowns of the pose.
  void addSurface(const Eigen::Matrix<double, 6, 1>& jacobian, double residual, double weight) {
    for (int column = 0; column < 6; ++column) {
      const double weighted = weight * jacobian[column];
      for (int row = column; row < 6; ++row) matrix_(row, column) += weighted * jacobian[row];
      right_[column] -= weighted * residual;
    }
  }

  /// A pose that is known from elsewhere; `error` is from it to the current one, in the camera's axes.
  void addPose(const Eigen::Matrix<double, 6, 6>& information, const Eigen::Matrix<double, 6, 1>& error) {
    matrix_.topLeftCorner<6, 6>() += information;
    right_.head<6>() -= information * error;
  }

  /// The step that solves them.
  Vector8d solve() const;
  /// The information on the pose when gain and offset are unknown (Schur complement).
  Eigen::Matrix<double, 6, 6> poseInformation() const;

 private:
  Matrix8d damped() const;

  Matrix8d matrix_;  ///< Only the lower triangle.
  Vector8d right_;
};

}  // namespace swiftlet::mapping3d
