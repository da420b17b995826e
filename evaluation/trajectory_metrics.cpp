#include "evaluation/trajectory_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "common/check.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Duration;
using common::Pose3;

Duration magnitude(Duration d) { return d < Duration() ? -d : d; }

/// Points closer together than this give no direction.
constexpr double kLeastSpread_m2 = 1e-12;

struct Means {
  Eigen::Vector3d estimate = Eigen::Vector3d::Zero();
  Eigen::Vector3d truth = Eigen::Vector3d::Zero();
};

Means meansOf(const std::vector<PosePair>& pairs) {
  Means means;
  for (const PosePair& pair : pairs) {
    means.estimate += pair.estimate.position_m;
    means.truth += pair.truth.position_m;
  }
  means.estimate /= static_cast<double>(pairs.size());
  means.truth /= static_cast<double>(pairs.size());
  return means;
}

/// The transform with this rotation that maps mean to mean.
Pose3 about(const Means& means, const Eigen::Quaterniond& rotation) {
  return {rotation, means.truth - rotation * means.estimate};
}

std::optional<Pose3> alignPlanar(const std::vector<PosePair>& pairs) {
  const Means means = meansOf(pairs);
  double dot_m2 = 0, cross_m2 = 0;
  for (const PosePair& pair : pairs) {
    const Eigen::Vector3d a = pair.estimate.position_m - means.estimate, b = pair.truth.position_m - means.truth;
    dot_m2 += a.x() * b.x() + a.y() * b.y();
    cross_m2 += a.x() * b.y() - a.y() * b.x();
  }
  if (std::hypot(dot_m2, cross_m2) < kLeastSpread_m2) return std::nullopt;
  return about(means, common::quaternionFrom({0.0, 0.0, std::atan2(cross_m2, dot_m2)}));
}

/// Umeyama 1991, eq. 40-43, without scale, which changes nothing about the rotation.
std::optional<Pose3> alignSpatial(const std::vector<PosePair>& pairs) {
  const Means means = meansOf(pairs);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const PosePair& pair : pairs)
    covariance += (pair.truth.position_m - means.truth) * (pair.estimate.position_m - means.estimate).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.singularValues()[1] < kLeastSpread_m2) return std::nullopt;
  // A reflection would fit better, but no vehicle can move so.
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1.0 : 1.0;
  const Eigen::Matrix3d rotation =
      svd.matrixU() * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
  return about(means, Eigen::Quaterniond(rotation).normalized());
}

double angleOf(const Eigen::Quaterniond& rotation) { return common::logSO3(rotation).norm(); }

/// Position of each pair along the chosen unit of stretches.
std::vector<double> measure(const std::vector<PosePair>& pairs, Stretch::Unit unit) {
  std::vector<double> at(pairs.size(), 0.0);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    switch (unit) {
      case Stretch::Unit::kFrames:
        at[i] = static_cast<double>(i);
        break;
      case Stretch::Unit::kSeconds:
        at[i] = (pairs[i].stamp - pairs[0].stamp).seconds();
        break;
      case Stretch::Unit::kMetres:
        at[i] = at[i - 1] + (pairs[i].truth.position_m - pairs[i - 1].truth.position_m).norm();
        break;
    }
  }
  return at;
}

}  // namespace

std::vector<PosePair> associate(const common::Trajectory& estimate, const common::Trajectory& truth,
                                Duration max_difference) {
  if (truth.empty()) return {};
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> taken_by(truth.size(), kNone);
  const auto difference = [&](std::size_t e, std::size_t t) { return magnitude(estimate[e].stamp - truth[t].stamp); };
  for (std::size_t e = 0; e < estimate.size(); ++e) {
    const std::size_t t = common::nearestTo(truth, estimate[e].stamp);
    if (difference(e, t) > max_difference) continue;
    if (taken_by[t] == kNone || difference(e, t) < difference(taken_by[t], t)) taken_by[t] = e;
  }
  std::vector<PosePair> pairs;
  for (std::size_t t = 0; t < truth.size(); ++t)
    if (taken_by[t] != kNone) pairs.push_back({estimate[taken_by[t]].stamp, estimate[taken_by[t]].pose, truth[t].pose});
  return pairs;
}

std::optional<Pose3> align(const std::vector<PosePair>& pairs, Alignment alignment) {
  if (pairs.empty()) return std::nullopt;
  switch (alignment) {
    case Alignment::kNone:
      return Pose3{};
    case Alignment::kFirstPose:
      return pairs.front().truth * pairs.front().estimate.inverse();
    case Alignment::kPlanar:
      return alignPlanar(pairs);
    case Alignment::kSpatial:
      return alignSpatial(pairs);
  }
  SWIFTLET_CHECK(false, static_cast<int>(alignment));
}

std::optional<double> bestScale(const std::vector<PosePair>& pairs, Alignment alignment) {
  SWIFTLET_CHECK(alignment == Alignment::kPlanar || alignment == Alignment::kSpatial, static_cast<int>(alignment));
  const std::optional<Pose3> T_truth_estimate = align(pairs, alignment);
  if (!T_truth_estimate) return std::nullopt;
  const Means means = meansOf(pairs);
  double product_m2 = 0, spread_m2 = 0;
  for (const PosePair& pair : pairs) {
    const Eigen::Vector3d turned = T_truth_estimate->rotation * (pair.estimate.position_m - means.estimate);
    product_m2 += turned.dot(pair.truth.position_m - means.truth);
    spread_m2 += turned.squaredNorm();
  }
  if (product_m2 <= 0) return std::nullopt;
  return product_m2 / spread_m2;
}

std::vector<PosePair> scaled(std::vector<PosePair> pairs, double scale) {
  for (PosePair& pair : pairs) pair.estimate.position_m *= scale;
  return pairs;
}

std::optional<AbsoluteError> absoluteTrajectoryError(const std::vector<PosePair>& pairs, Alignment alignment) {
  const std::optional<Pose3> T_truth_estimate = align(pairs, alignment);
  if (!T_truth_estimate) return std::nullopt;
  std::vector<double> translations_m, rotations_rad;
  for (const PosePair& pair : pairs) {
    const Pose3 error = pair.truth.inverse() * (*T_truth_estimate * pair.estimate);
    translations_m.push_back(error.position_m.norm());
    rotations_rad.push_back(angleOf(error.rotation));
  }
  return AbsoluteError{*T_truth_estimate, statisticsOf(translations_m), statisticsOf(rotations_rad)};
}

RelativeError relativePoseError(const std::vector<PosePair>& pairs, const Stretch& stretch) {
  constexpr double kRounding = 1e-9;
  const std::vector<double> at = measure(pairs, stretch.unit);
  std::vector<double> translations_m, rotations_rad;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto end =
        std::lower_bound(at.begin() + static_cast<std::ptrdiff_t>(i), at.end(), at[i] + stretch.length - kRounding);
    if (end == at.end()) break;
    const PosePair& to = pairs[static_cast<std::size_t>(end - at.begin())];
    const Pose3 moved_estimate = pairs[i].estimate.inverse() * to.estimate;
    const Pose3 moved_truth = pairs[i].truth.inverse() * to.truth;
    const Pose3 error = moved_truth.inverse() * moved_estimate;
    translations_m.push_back(error.position_m.norm());
    rotations_rad.push_back(angleOf(error.rotation));
  }
  return {statisticsOf(translations_m), statisticsOf(rotations_rad)};
}

}  // namespace swiftlet::evaluation
