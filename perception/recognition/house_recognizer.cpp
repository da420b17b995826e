#include "perception/recognition/house_recognizer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/geometry.hpp"
#include "common/square.hpp"
#include "perception/recognition/house_check.hpp"
#include "perception/recognition/house_chimney.hpp"
#include "perception/recognition/house_fit.hpp"
#include "perception/recognition/house_points.hpp"

namespace swiftlet::perception {
namespace {

/// Fewer points are no house; of more than so many groups the smaller ones are furniture.
constexpr std::size_t kGroups = 3;
/// Of the inverse depth, equal in all pixels (config/nature/real.yaml: within 0.001).
constexpr double kHouseBias_1_m = 0.0006;
/// Of the attitude, which no depth shows: it tilts what is taken for level.
constexpr double kTiltSigma_rad = 0.5 * common::kRadPerDeg;

Recognized recognizedHouse(const HouseConfig& config, const HousePose& pose, double confidence, const DepthView& view) {
  const Eigen::Matrix3d R_camera_level = view.R_level_camera.transpose();
  Recognized house;
  house.what = config.name;
  house.confidence = confidence;
  house.size_m = {config.model.length_m, config.model.width_m};
  house.T_sensor_object = {
      Eigen::Quaterniond(R_camera_level) * Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ()),
      R_camera_level * pose.position_m};
  Eigen::Matrix<double, 6, 6> level = Eigen::Matrix<double, 6, 6>::Zero();
  level(0, 0) = level(1, 1) = common::square(kTiltSigma_rad);
  level(2, 2) = pose.covariance(3, 3);
  level.bottomRightCorner<3, 3>() = pose.covariance.topLeftCorner<3, 3>();
  level.block<3, 1>(3, 2) = pose.covariance.topRightCorner<3, 1>();
  level.block<1, 3>(2, 3) = pose.covariance.bottomLeftCorner<1, 3>();
  // An inverse depth that is off by b moves a point by b times its depth squared, along its ray.
  const Eigen::Vector3d along = pose.position_m.norm() * pose.position_m;
  level.bottomRightCorner<3, 3>() += common::square(kHouseBias_1_m) * along * along.transpose();
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R_camera_level;
  house.covariance = turn * level * turn.transpose();
  return house;
}

/// The first of the fitted poses that explains the picture.
std::optional<Recognized> houseAmong(const std::vector<HousePoint>& group, const HouseConfig& config,
                                     const CameraPicture& picture, const DepthView& view, double ground_m) {
  for (const HousePose& pose : fitHouse(config.model, group, ground_m)) {
    const HouseEvidence evidence = evidenceFor(pose, config.model, view, ground_m);
    if (!isThatHouse(evidence)) continue;
    if (const auto with_chimney = fusedWithChimney(pose, config.model, picture, view))
      return recognizedHouse(config, with_chimney->pose, evidence.share() * with_chimney->sure, view);
  }
  return std::nullopt;
}

}  // namespace

std::vector<Recognized> HouseRecognizer::recognize(const Observation& observation) {
  std::vector<Recognized> houses;
  if (!hasWholePicture(observation) || !hasWholeDepths(observation)) return houses;
  const DepthView view{observation.frame->camera, observation.frame->depth,
                       observation.R_level_camera.toRotationMatrix(), config_.inverse_depth_sigma_1_m,
                       config_.range_max_m};
  const std::vector<HousePoint> points = housePoints(view);
  const auto ground_m = groundOf(points);
  if (!ground_m) return houses;
  std::vector<std::vector<HousePoint>> groups = standingGroups(points, *ground_m, config_.model);
  groups.resize(std::min(groups.size(), kGroups));
  for (const std::vector<HousePoint>& group : groups)
    if (auto house = houseAmong(group, config_, *observation.picture, view, *ground_m))
      houses.push_back(*std::move(house));
  std::stable_sort(houses.begin(), houses.end(),
                   [](const Recognized& a, const Recognized& b) { return a.confidence > b.confidence; });
  return houses;
}

}  // namespace swiftlet::perception
