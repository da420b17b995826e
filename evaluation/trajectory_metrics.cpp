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

/// The index of the pose nearest in time; `trajectory` is not empty.
std::size_t nearest(const common::Trajectory& trajectory, common::Time stamp) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), stamp,
                                      [](const common::StampedPose& pose, common::Time t) { return pose.stamp < t; });
  const std::size_t index = static_cast<std::size_t>(after - trajectory.begin());
  if (index == 0) return 0;
  if (index == trajectory.size()) return index - 1;
  return stamp - trajectory[index - 1].stamp <= trajectory[index].stamp - stamp ? index - 1 : index;
}

template <int kDimension>
using Points = Eigen::Matrix<double, kDimension, Eigen::Dynamic>;

/// The rotation and translation that bring `from` onto `to`; none when fewer than kDimension - 1 directions of the
/// points are determined.
template <int kDimension>
std::optional<Eigen::Matrix<double, kDimension + 1, kDimension + 1>> umeyama(const Points<kDimension>& from,
                                                                             const Points<kDimension>& to) {
  const auto spread = [](const Points<kDimension>& points) {
    const Points<kDimension> centred = points.colwise() - points.rowwise().mean();
    return Eigen::Matrix<double, kDimension, 1>(
        Eigen::JacobiSVD<Eigen::Matrix<double, kDimension, kDimension>>(centred * centred.transpose())
            .singularValues());
  };
  // A rotation is determined when the points spread in all directions but one.
  const double from_spread = spread(from)[kDimension - 2], to_spread = spread(to)[kDimension - 2];
  constexpr double kLeast_m2 = 1e-12;
  if (from_spread < kLeast_m2 || to_spread < kLeast_m2) return std::nullopt;
  return Eigen::umeyama(from, to, false);
}

std::optional<Pose3> alignPlanar(const std::vector<PosePair>& pairs) {
  Points<2> from(2, pairs.size()), to(2, pairs.size());
  double rise_m = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = pairs[i].estimate.position_m.head<2>();
    to.col(static_cast<Eigen::Index>(i)) = pairs[i].truth.position_m.head<2>();
    rise_m += (pairs[i].truth.position_m.z() - pairs[i].estimate.position_m.z()) / static_cast<double>(pairs.size());
  }
  const auto T = umeyama<2>(from, to);
  if (!T) return std::nullopt;
  return common::lifted({(*T)(0, 2), (*T)(1, 2), std::atan2((*T)(1, 0), (*T)(0, 0))}, rise_m);
}

std::optional<Pose3> alignSpatial(const std::vector<PosePair>& pairs) {
  Points<3> from(3, pairs.size()), to(3, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = pairs[i].estimate.position_m;
    to.col(static_cast<Eigen::Index>(i)) = pairs[i].truth.position_m;
  }
  const auto T = umeyama<3>(from, to);
  if (!T) return std::nullopt;
  const Eigen::Matrix3d rotation = T->topLeftCorner<3, 3>();
  return Pose3{Eigen::Quaterniond(rotation).normalized(), T->topRightCorner<3, 1>()};
}

double angleOf(const Eigen::Quaterniond& rotation) { return common::logSO3(rotation).norm(); }

/// How far along the stretches' unit each pair is.
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
  constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> taken_by(truth.size(), kNobody);
  const auto difference = [&](std::size_t e, std::size_t t) { return magnitude(estimate[e].stamp - truth[t].stamp); };
  for (std::size_t e = 0; e < estimate.size(); ++e) {
    const std::size_t t = nearest(truth, estimate[e].stamp);
    if (difference(e, t) > max_difference) continue;
    if (taken_by[t] == kNobody || difference(e, t) < difference(taken_by[t], t)) taken_by[t] = e;
  }
  std::vector<PosePair> pairs;
  for (std::size_t t = 0; t < truth.size(); ++t)
    if (taken_by[t] != kNobody)
      pairs.push_back({estimate[taken_by[t]].stamp, estimate[taken_by[t]].pose, truth[t].pose});
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
  const std::vector<double> at = measure(pairs, stretch.unit);
  std::vector<double> translations_m, rotations_rad;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto end = std::lower_bound(at.begin() + static_cast<std::ptrdiff_t>(i), at.end(), at[i] + stretch.length);
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
