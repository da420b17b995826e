// The odometry of inputs that are skipped for lack of a pose, added to that of the next one with a pose.
#pragma once

#include <utility>

#include <Eigen/Core>

#include "perception/laser_odometry/unknown_step.hpp"
#include "perception/localization/localization_input.hpp"

namespace swiftlet::perception {

class SkippedInputs {
 public:
  void add(const LocalizationInput& input) {
    covariance_ += stepCovarianceOrUnknown(input.step_covariance);
    interrupted_ |= input.interrupted;
  }

  /// The input with all that was added before, itself included; what was added is forgotten.
  LocalizationInput included(LocalizationInput input) {
    input.step_covariance = std::exchange(covariance_, Eigen::Matrix3d::Zero());
    input.interrupted = std::exchange(interrupted_, false);
    return input;
  }

 private:
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  bool interrupted_ = false;
};

}  // namespace swiftlet::perception
