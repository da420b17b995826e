#include "mapping3d/landmarks/landmark_icp.hpp"

#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace swiftlet::mapping3d {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Landmarks farther from a feature are no candidates.
constexpr double kReach_m = 0.15;
/// Squared Mahalanobis distance of a match, at most: 99 % of chi-squared with 3 degrees of freedom.
constexpr double kGate = 11.3;
/// What the pose may add to the distance of a match, as a standard deviation: at first, and from one iteration to the
/// next. The last iterations know nothing but the covariances.
constexpr double kFirstSigma_m = 0.04, kSigmaFactor = 0.5, kLeastSigma_m = 0.001;
constexpr int kMostIterations = 15;
constexpr double kConverged_m = 1e-5, kConverged_rad = 1e-5;

/// Landmarks in the axes of the camera.
struct Seen {
  std::vector<Eigen::Vector3d> means_m;
  std::vector<Eigen::Matrix3d> covariances_m2;
};

Seen seenFrom(const common::Pose3& T_map_camera, std::span<const Landmark> landmarks) {
  Seen seen;
  const Eigen::Matrix3d R_camera_map = T_map_camera.rotation.toRotationMatrix().transpose();
  for (const Landmark& landmark : landmarks) {
    seen.means_m.emplace_back(R_camera_map * (landmark.mean_map_m - T_map_camera.position_m));
    seen.covariances_m2.emplace_back(R_camera_map * landmark.covariance_map_m2 * R_camera_map.transpose());
  }
  return seen;
}

/// For each landmark, the feature that is nearest to it of those that it is the nearest to.
struct Association {
  std::vector<LandmarkMatch> matches;
  int in_reach = 0;  ///< Features with a candidate.
};

Association associated(std::span<const vision::Feature> features, const Seen& seen, double sigma_m) {
  struct Best {
    std::size_t feature = 0;
    double distance = kGate;
  };
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  const Eigen::Matrix3d search = sigma_m * sigma_m * Eigen::Matrix3d::Identity();
  Association association;
  std::vector<Best> best_of(seen.means_m.size(), Best{kNone});
  for (std::size_t i = 0; i < features.size(); ++i) {
    LandmarkMatch nearest{i, kNone};
    double least = kGate;
    bool in_reach = false;
    for (std::size_t j = 0; j < seen.means_m.size(); ++j) {
      const Eigen::Vector3d error = seen.means_m[j] - features[i].mean_camera_m;
      if (error.squaredNorm() > kReach_m * kReach_m) continue;
      in_reach = true;
      const Eigen::Matrix3d sum = seen.covariances_m2[j] + features[i].covariance_camera_m2 + search;
      // No variance along any direction exceeds the trace, so that most candidates need no inverse.
      if (error.squaredNorm() >= least * sum.trace()) continue;
      const double distance = error.dot(sum.inverse() * error);
      if (distance >= least) continue;
      least = distance;
      nearest.landmark = j;
    }
    association.in_reach += in_reach ? 1 : 0;
    if (nearest.landmark != kNone && least < best_of[nearest.landmark].distance) best_of[nearest.landmark] = {i, least};
  }
  std::vector<std::size_t> landmark_of(features.size(), kNone);
  for (std::size_t j = 0; j < best_of.size(); ++j)
    if (best_of[j].feature != kNone) landmark_of[best_of[j].feature] = j;
  for (std::size_t i = 0; i < landmark_of.size(); ++i)
    if (landmark_of[i] != kNone) association.matches.push_back({i, landmark_of[i]});
  return association;
}

/// The step (x, y, z, rotation vector) of Gauss-Newton in the axes of the camera.
Vector6d step(std::span<const vision::Feature> features, const Seen& seen, const std::vector<LandmarkMatch>& matches,
              double sigma_m, const PosePrior& prior, Alignment& fit) {
  Vector6d gradient = Vector6d::Zero();
  fit.measured_information.setZero();
  const Eigen::Matrix3d search = sigma_m * sigma_m * Eigen::Matrix3d::Identity();
  for (const LandmarkMatch& match : matches) {
    const vision::Feature& feature = features[match.feature];
    const Eigen::Vector3d& landmark_m = seen.means_m[match.landmark];
    const Eigen::Matrix3d weight =
        (seen.covariances_m2[match.landmark] + feature.covariance_camera_m2 + search).inverse();
    // A step d of the camera moves the landmark in its axes by -d.head - d.tail x landmark.
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian << -Eigen::Matrix3d::Identity(), common::skew(landmark_m);
    fit.measured_information += jacobian.transpose() * weight * jacobian;
    gradient += jacobian.transpose() * weight * (landmark_m - feature.mean_camera_m);
  }
  const common::Pose3 left = prior.T_map_camera.inverse() * fit.T_map_camera;
  Vector6d from_prior;
  from_prior << left.position_m, common::logSO3(left.rotation);
  gradient += prior.information * from_prior;
  fit.information = fit.measured_information + prior.information;
  return -fit.information.ldlt().solve(gradient);
}

}  // namespace

ModelMatch matchToModel(std::span<const vision::Feature> features, std::span<const Landmark> landmarks,
                        const PosePrior& prior) {
  constexpr std::size_t kLeastMatches = 6;
  ModelMatch result;
  Alignment& fit = result.fit;
  fit.T_map_camera = prior.T_map_camera;
  double sigma_m = kFirstSigma_m;
  for (int i = 0; i < kMostIterations; ++i) {
    const Seen seen = seenFrom(fit.T_map_camera, landmarks);
    Association association = associated(features, seen, sigma_m);
    if (i == 0) fit.measured = association.in_reach;
    result.matches = std::move(association.matches);
    if (result.matches.size() < kLeastMatches) break;
    const Vector6d moved = step(features, seen, result.matches, sigma_m, prior, fit);
    if (!moved.allFinite()) break;
    fit.T_map_camera = fit.T_map_camera * common::Pose3{common::expSO3(moved.tail<3>()), moved.head<3>()};
    fit.T_map_camera.rotation.normalize();
    if (sigma_m == 0.0 && moved.head<3>().norm() < kConverged_m && moved.tail<3>().norm() < kConverged_rad) break;
    sigma_m = kSigmaFactor * sigma_m > kLeastSigma_m ? kSigmaFactor * sigma_m : 0.0;
  }
  fit.points = static_cast<int>(result.matches.size());
  fit.agreement = fit.measured > 0 ? static_cast<double>(fit.points) / fit.measured : 0.0;
  return result;
}

}  // namespace swiftlet::mapping3d
