#include "perception/fusion/taped_flight.hpp"

#include <variant>

#include <Eigen/Geometry>

namespace swiftlet::perception {
namespace {

/// Other inputs belong to the sample before them.
bool isSampleAfter(const FilterInput& input, common::Time time) {
  const auto* imu = std::get_if<common::ImuSample>(&input);
  return imu != nullptr && imu->stamps.arrived > time;
}

}  // namespace

const TrueMotion* TapedReplay::next(const Told& told) {
  if (next_truth_ == flight_.truth.size()) return nullptr;
  const TrueMotion& truth = flight_.truth[next_truth_++];
  for (; next_input_ < flight_.inputs.size(); ++next_input_) {
    const FilterInput& input = flight_.inputs[next_input_];
    if (isSampleAfter(input, truth.stamp)) break;
    tell(filter_, input);
    if (told) told(input);
  }
  return &truth;
}

Eigen::Vector3d inLevelBody(double yaw_rad, const Eigen::Vector3d& velocity_m_s) {
  return Eigen::AngleAxisd(-yaw_rad, Eigen::Vector3d::UnitZ()) * velocity_m_s;
}

}  // namespace swiftlet::perception
