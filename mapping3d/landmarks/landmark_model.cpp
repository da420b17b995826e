#include "mapping3d/landmarks/landmark_model.hpp"

#include <algorithm>
#include <optional>

#include <Eigen/LU>

namespace swiftlet::mapping3d {
namespace {

/// Corners are where the texture is, not where a point of the world is: seen from elsewhere they move by about this. A
/// landmark never becomes more certain.
constexpr double kFloor_m = 0.002;

Eigen::Matrix3d covarianceInMap(const vision::Feature& feature, const common::Pose3& T_map_camera) {
  const Eigen::Matrix3d rotation = T_map_camera.rotation.toRotationMatrix();
  return rotation * feature.covariance_camera_m2 * rotation.transpose();
}

}  // namespace

const Landmark* LandmarkModel::find(std::uint64_t number) const {
  const auto found = std::lower_bound(landmarks_.begin(), landmarks_.end(), number,
                                      [](const Landmark& one, std::uint64_t sought) { return one.number < sought; });
  return found != landmarks_.end() && found->number == number ? &*found : nullptr;
}

Landmark* LandmarkModel::changeable(std::uint64_t number) {
  const Landmark* found = find(number);
  return found != nullptr ? landmarks_.data() + (found - landmarks_.data()) : nullptr;
}

std::vector<Landmark> LandmarkModel::inView(const common::PinholeCamera& camera, const common::Pose3& T_map_camera,
                                            double margin_px) const {
  std::vector<Landmark> seen;
  const Eigen::Matrix3d R_camera_map = T_map_camera.rotation.toRotationMatrix().transpose();
  for (const Landmark& landmark : landmarks_) {
    const Eigen::Vector3d point = R_camera_map * (landmark.mean_map_m - T_map_camera.position_m);
    if (point.x() <= 0.0) continue;
    const Eigen::Vector2d pixel = camera.pixel(point);
    if (pixel.x() >= -margin_px && pixel.y() >= -margin_px && pixel.x() < camera.width_px + margin_px &&
        pixel.y() < camera.height_px + margin_px)
      seen.push_back(landmark);
  }
  return seen;
}

std::uint64_t LandmarkModel::add(const vision::Feature& feature, const common::Pose3& T_map_camera, int scan,
                                 std::uint64_t frame) {
  landmarks_.push_back(
      {next_number_, T_map_camera * feature.mean_camera_m, covarianceInMap(feature, T_map_camera), scan, frame, frame});
  return next_number_++;
}

void LandmarkModel::update(std::uint64_t number, const vision::Feature& feature, const common::Pose3& T_map_camera,
                           std::uint64_t frame) {
  Landmark* landmark = changeable(number);
  if (landmark == nullptr) return;
  const Eigen::Matrix3d& predicted = landmark->covariance_map_m2;
  const Eigen::Matrix3d gain = predicted * (predicted + covarianceInMap(feature, T_map_camera)).inverse();
  landmark->mean_map_m += gain * (T_map_camera * feature.mean_camera_m - landmark->mean_map_m);
  const Eigen::Matrix3d updated = predicted - gain * predicted;
  landmark->covariance_map_m2 = 0.5 * (updated + updated.transpose());
  landmark->covariance_map_m2.diagonal() = landmark->covariance_map_m2.diagonal().cwiseMax(kFloor_m * kFloor_m);
  landmark->last_seen = frame;
}

void LandmarkModel::moveTo(std::uint64_t number, const Eigen::Vector3d& mean_map_m) {
  if (Landmark* landmark = changeable(number)) landmark->mean_map_m = mean_map_m;
}

void LandmarkModel::shrink() {
  if (landmarks_.size() <= greatest_number_) return;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ages;
  for (const Landmark& landmark : landmarks_) ages.emplace_back(landmark.last_seen, landmark.number);
  const auto kept = ages.begin() + static_cast<std::ptrdiff_t>(ages.size() - greatest_number_);
  std::nth_element(ages.begin(), kept, ages.end());
  const auto oldest = *kept;
  std::erase_if(landmarks_, [&](const Landmark& one) { return std::pair(one.last_seen, one.number) < oldest; });
}

void LandmarkModel::hangOn(int scan, std::uint64_t first_seen) {
  for (Landmark& landmark : landmarks_)
    if (landmark.first_seen == first_seen) landmark.scan = scan;
}

void LandmarkModel::moveTo(const common::KeyPoses& from, const common::KeyPoses& to) {
  std::optional<int> scan;
  common::Pose3 moved;
  for (Landmark& landmark : landmarks_) {
    if (scan != landmark.scan) {  // Neighbours mostly hang on the same one.
      scan = landmark.scan;
      moved = to.T_map_level(*scan) * from.T_map_level(*scan).inverse();
    }
    landmark.mean_map_m = moved * landmark.mean_map_m;
    const Eigen::Matrix3d rotation = moved.rotation.toRotationMatrix();
    landmark.covariance_map_m2 = rotation * landmark.covariance_map_m2 * rotation.transpose();
  }
}

}  // namespace swiftlet::mapping3d
