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

TrueMotion between(const TrueMotion& before, const TrueMotion& after, common::Time time) {
  const double share = (time - before.stamp).seconds() / (after.stamp - before.stamp).seconds();
  const auto mixed = [share](const Eigen::Vector3d& a, const Eigen::Vector3d& b) -> Eigen::Vector3d {
    return a + share * (b - a);
  };
  const double turned_rad = common::wrapAngle(after.yaw_map_rad - before.yaw_map_rad);
  return {time, before.yaw_map_rad + share * turned_rad, mixed(before.velocity_map_m_s, after.velocity_map_m_s),
          mixed(before.position_map_m, after.position_map_m)};
}

}  // namespace

TrueMotion TapedReplay::truthOfState() const {
  const common::Time time = filter_.newest();
  std::size_t after = next_truth_ - 1;
  while (after > 1 && flight_.truth[after - 1].stamp > time) --after;
  if (after == 0 || time >= flight_.truth[after].stamp) return flight_.truth[after];
  return between(flight_.truth[after - 1], flight_.truth[after], time);
}

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
