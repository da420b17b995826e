#include "perception/recognition/house_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Dense>

#include "common/pose2.hpp"
#include "common/square.hpp"

namespace swiftlet::perception {
namespace {

/// What is that near to the height of the eaves or above belongs to the roof.
constexpr double kRoofBelow_m = 0.15;
constexpr std::size_t kLeastRoof = 60, kLeastFit = 120;
/// A point farther from the shape is of something else; closer from round to round.
constexpr std::array kFitGates_m = {1.0, 1.0, 0.7, 0.7, 0.5, 0.5, 0.35, 0.35, 0.25, 0.25, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2};
/// How far real walls and roofs are from the planes of the model.
constexpr double kShapeSigma_m = 0.03;
/// The height of the ground is known to so much: it is uneven, and the attitude is off.
constexpr double kGroundSigma_m = 0.05;
/// Neighbouring points err alike: of so many one counts.
constexpr double kFitCorrelated = 20.0;
/// Two poses that are that near are one; half a turn apart they are the same shape.
constexpr double kSamePose_m = 0.15, kSamePose_rad = 0.1;

struct RoofSpread {
  Eigen::Vector2d middle_m = Eigen::Vector2d::Zero();
  double axis_rad = 0.0;  ///< In which it is the longest.
};

/// Principal components of the points of the roof, from above; of all points where the roof is not seen.
RoofSpread spreadOf(const std::vector<HousePoint>& points, double roof_m) {
  const auto roof =
      std::count_if(points.begin(), points.end(), [&](const HousePoint& point) { return point.at_m.z() > roof_m; });
  const bool all = static_cast<std::size_t>(roof) < kLeastRoof;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  double weights = 0.0;
  for (const HousePoint& point : points) {
    if (!all && point.at_m.z() <= roof_m) continue;
    // A pixel far away stands for a larger piece of the roof.
    const double weight = point.at_m.squaredNorm();
    const Eigen::Vector2d at = point.at_m.head<2>();
    sum += weight * at;
    squares += weight * at * at.transpose();
    weights += weight;
  }
  const Eigen::Vector2d middle = sum / weights;
  const Eigen::Matrix2d spread = squares / weights - middle * middle.transpose();
  const Eigen::Vector2d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1);
  return {middle, std::atan2(axis.y(), axis.x())};
}

/// One round of ICP: the step that brings the points to the planes of the faces on which they lie.
struct FitRound {
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
  std::size_t fitting = 0;
};

FitRound roundOf(const HouseBody& body, const std::vector<HousePoint>& points, const HousePose& pose, double ground_m,
                 double gate_m) {
  FitRound round;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (const HousePoint& point : points) {
    const Eigen::Vector3d at = pose.inHouse_m(point.at_m);
    const int face = body.faceOf(at);
    const double off_m = body.off_m(at, face);
    if (std::abs(off_m) > gate_m) continue;
    ++round.fitting;
    const Eigen::Vector3d normal = R * body.faces()[static_cast<std::size_t>(face)].normal;
    const double along = std::abs(normal.dot(point.at_m.normalized()));
    const double variance_m2 = common::square(kShapeSigma_m) + common::square(along * point.sigma_m);
    // Tukey's biweight: what is near the gate counts little.
    const double weight = common::square(1.0 - common::square(off_m / gate_m)) / variance_m2;
    Eigen::Vector4d by_pose;
    by_pose.head<3>() = -normal;
    const Eigen::Vector3d lever = point.at_m - pose.position_m;
    by_pose[3] = -normal.dot(Eigen::Vector3d::UnitZ().cross(lever));
    round.information += weight * by_pose * by_pose.transpose();
    round.gradient += weight * by_pose * off_m;
  }
  round.information /= kFitCorrelated;
  round.gradient /= kFitCorrelated;
  round.information(2, 2) += 1.0 / common::square(kGroundSigma_m);
  round.gradient[2] += (pose.position_m.z() - ground_m) / common::square(kGroundSigma_m);
  return round;
}

std::optional<HousePose> alignedFrom(HousePose pose, const HouseBody& body, const std::vector<HousePoint>& points,
                                     double ground_m) {
  for (const double gate_m : kFitGates_m) {
    const FitRound round = roundOf(body, points, pose, ground_m, gate_m);
    if (round.fitting < kLeastFit) return std::nullopt;
    // A direction that no point fixes stays where it is.
    const Eigen::Matrix4d held = round.information + 1e-3 * Eigen::Matrix4d::Identity();
    const Eigen::Vector4d step = -held.ldlt().solve(round.gradient);
    if (!step.allFinite()) return std::nullopt;
    pose.position_m += step.head<3>();
    pose.yaw_rad = common::wrapAngle(pose.yaw_rad + step[3]);
    pose.covariance = held.inverse();
    pose.fit = static_cast<double>(round.fitting) / static_cast<double>(points.size());
  }
  return pose;
}

/// The shape is the same after half a turn.
bool isSamePose(const HousePose& a, const HousePose& b) {
  const double turn_rad = std::remainder(a.yaw_rad - b.yaw_rad, std::numbers::pi);
  return (a.position_m - b.position_m).norm() < kSamePose_m && std::abs(turn_rad) < kSamePose_rad;
}

}  // namespace

std::vector<HousePose> fitHouse(const HouseModel& model, const std::vector<HousePoint>& points, double ground_m) {
  std::vector<HousePose> poses;
  if (points.size() < kLeastFit) return poses;
  const HouseBody body(model);
  const RoofSpread spread = spreadOf(points, ground_m + model.eaves_m - kRoofBelow_m);
  for (const double turn_rad : {0.0, 0.5 * std::numbers::pi})
    // Where one side of the roof is seen its middle is a quarter of the width off.
    for (const double side : {0.0, 0.25, -0.25}) {
      const double yaw_rad = spread.axis_rad + turn_rad;
      const Eigen::Vector2d across(-std::sin(yaw_rad), std::cos(yaw_rad));
      HousePose start;
      start.position_m << spread.middle_m + side * model.width_m * across, ground_m;
      start.yaw_rad = common::wrapAngle(yaw_rad);
      const auto pose = alignedFrom(start, body, points, ground_m);
      if (!pose) continue;
      const auto same =
          std::find_if(poses.begin(), poses.end(), [&](const HousePose& one) { return isSamePose(one, *pose); });
      if (same == poses.end())
        poses.push_back(*pose);
      else if (pose->fit > same->fit)
        *same = *pose;
    }
  std::stable_sort(poses.begin(), poses.end(), [](const HousePose& a, const HousePose& b) { return a.fit > b.fit; });
  return poses;
}

}  // namespace swiftlet::perception
