#include "perception/scan_matching/least_squares_match.hpp"

#include <algorithm>
#include <cmath>

#include "common/small_matrices.hpp"
#include "perception/scan_matching/scan_contour.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose2;

/// The match failed when a smaller share of the contour facing some direction has support: the other walls fit, and
/// these were rejected as outliers.
constexpr double kMinDirectionSupport = 0.25;
/// Factor on the covariance of independent points, calibrated by the tests of the covariance
/// (tests/scan_matching/least_squares_matchers_test.cpp).
constexpr double kCovarianceScale = 2.0;
/// Error of roll and pitch, which moves each end point by its height over the body times this.
constexpr double kAttitudeError_deg = 1.0;
/// A direction less certain than this is not observed: the pose keeps the guess there.
constexpr double kUnobservableSigma_m = 0.1;
/// A motion that a smaller share of the contour faces is not observed: along a corridor's axis, or about the middle of
/// a round room.
constexpr double kMinNormalSpread = 0.01;

/// Lower limit on the residual of the end points.
constexpr double kMinResidual_m = 0.004;
/// Residual assumed during the iterations to decide which directions are observable: the measured residual is then that
/// of a misplaced scan.
constexpr double kUnderwayResidual_m = 0.02;
/// A pose within this distance of the window's edge, on either side, is at the edge. Farther outside, the match failed.
constexpr double kEdge_m = 0.01;
constexpr double kEdge_rad = 0.1 * kRadPerDeg;
constexpr double kScorePerPoint = 255.0;  ///< LikelihoodField::kTopValue, so that scores compare with the search's.

}  // namespace

void NormalEquations::addTilt(const Eigen::Vector2d& arm_m, const Eigen::Vector2d& normal, double height_m,
                              double inverse_lever) {
  const double turn = (arm_m.x() * normal.y() - arm_m.y() * normal.x()) * inverse_lever;
  tilt += Eigen::Vector3d(normal.x(), normal.y(), turn) * (height_m * normal.transpose());
}

LeastSquaresMatch::LeastSquaresMatch(const ProjectedScan& scan, const Pose2& guess, const SearchWindow& window)
    : points_(orientedPoints(scan, kPoints, kMaxGap_m, ScanMatcher::kMaxRange_m)), guess_(guess), window_(window) {
  if (points_.empty()) return;
  std::vector<float> x_m, y_m;
  for (const OrientedPoint& p : points_) {
    x_m.push_back(p.point_m.x());
    y_m.push_back(p.point_m.y());
  }
  lever_m_ = leverOf_m(x_m, y_m);
  held_level_ = slidingMotion(motionSpread(x_m, y_m, lever_m_), lever_m_, kMinNormalSpread);
}

std::optional<common::UnobservableMotion> LeastSquaresMatch::heldMotion(double yaw_rad) const {
  if (!held_level_) return std::nullopt;
  return common::turned(*held_level_, yaw_rad);
}

Quadratic LeastSquaresMatch::quadraticAt(const NormalEquations& equations,
                                         const std::optional<common::UnobservableMotion>& held) const {
  Eigen::Matrix3d kept = Eigen::Matrix3d::Identity();
  if (held) {
    const Eigen::Vector3d along = held->change.cwiseProduct(Eigen::Vector3d(1.0, 1.0, lever_m_)).normalized();
    kept -= along * along.transpose();
  }
  const NormalEquations& e = equations;
  Eigen::Matrix3d curvature;
  curvature << e.xx, e.xy, e.xt, e.xy, e.yy, e.yt, e.xt, e.yt, e.tt;
  Quadratic quadratic;
  quadratic.gradient = -kept * Eigen::Vector3d(e.x, e.y, e.t);
  quadratic.hessian = -kept * curvature * kept;
  return quadratic;
}

double LeastSquaresMatch::step(const NormalEquations& equations, double reach_m, Pose2& pose) const {
  PeakScale scale;
  scale.step = {1.0, 1.0, inverseLever()};
  scale.information_per_curvature = 1.0 / (kUnderwayResidual_m * kUnderwayResidual_m * kCovarianceScale);
  scale.unobservable_sigma_m = kUnobservableSigma_m;
  scale.reach_steps = reach_m;
  const Quadratic quadratic = quadraticAt(equations, heldMotion(pose.yaw_rad));
  const Eigen::Vector3d offset = findPeak(quadratic, scale, expectedFrom(pose, guess_, window_)).offset;
  pose.x_m += offset.x();
  pose.y_m += offset.y();
  pose.yaw_rad = common::wrapAngle(pose.yaw_rad + offset.z());
  return offset.cwiseQuotient(scale.step).norm();
}

void LeastSquaresMatch::judgeWindow(MatchResult& result) const {
  const Eigen::Vector3d away = expectedFrom(result.T_reference_body, guess_, window_).offset.cwiseAbs();
  const double half_m = window_.half_translation_m, half_rad = window_.half_rotation_rad;
  const double farthest_m = away.head<2>().maxCoeff();
  result.at_window_edge = farthest_m > half_m - std::min(kEdge_m, 0.5 * half_m) ||
                          away.z() > half_rad - std::min(kEdge_rad, 0.5 * half_rad);
  const bool is_inside = farthest_m <= half_m + kEdge_m && away.z() <= half_rad + kEdge_rad;
  if (!is_inside) result.failed = true;
}

/// The share of the contour that has support, for the direction that has the least. Directions the scan does not
/// constrain are left out.
double LeastSquaresMatch::leastSupport(const NormalEquations& equations, double yaw_rad) const {
  Eigen::Matrix2d facing = Eigen::Matrix2d::Zero(), supported;
  for (const OrientedPoint& p : points_) {
    const Eigen::Vector2d normal = p.normal.cast<double>();
    facing += normal * normal.transpose();
  }
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(yaw_rad).toRotationMatrix();
  supported << equations.xx, equations.xy, equations.xy, equations.yy;
  supported = R.transpose() * supported * R;
  // A turn that is not seen leaves both directions to compare, a translation the one across.
  if (held_level_ && isTranslation(*held_level_)) {
    const Eigen::Vector2d seen = held_level_->change.head<2>().unitOrthogonal();
    return seen.dot(supported * seen) / seen.dot(facing * seen);
  }
  return common::generalizedEigenvalues(supported, facing)(0);
}

MatchResult LeastSquaresMatch::finish(const NormalEquations& equations, double quality_sum, bool converged,
                                      const Pose2& pose) const {
  MatchResult result;
  result.points_used = static_cast<int>(points_.size());
  result.finest_T_reference_body = result.T_reference_body = pose;
  result.finest_score = static_cast<int>(quality_sum * kScorePerPoint);
  result.quality = quality_sum / static_cast<double>(points_.size());
  result.overlap = static_cast<double>(equations.count) / static_cast<double>(points_.size());
  if (!isFinite(pose)) {
    result.T_reference_body = result.finest_T_reference_body = guess_;
    return result;
  }

  const double residual2 = equations.squares_m2 / std::max(equations.count, 1);
  PeakScale scale;
  scale.step = {1.0, 1.0, inverseLever()};
  scale.information_per_curvature = 1.0 / (std::max(residual2, kMinResidual_m * kMinResidual_m) * kCovarianceScale);
  scale.unobservable_sigma_m = kUnobservableSigma_m;
  scale.reach_steps = kSupport_m;
  const std::optional<common::UnobservableMotion> held = heldMotion(pose.yaw_rad);
  const Peak peak = findPeak(quadraticAt(equations, held), scale, expectedFrom(pose, guess_, window_));
  // An attitude error moves all points together, so more points do not average it out.
  const Eigen::Matrix<double, 3, 2> shift = peak.peak_of_gradient * equations.tilt * (kAttitudeError_deg * kRadPerDeg);
  result.covariance = peak.covariance + shift * shift.transpose();
  result.unobservable_motion = held ? held : peak.unobservable_motion;
  result.T_reference_body.x_m += peak.offset.x();
  result.T_reference_body.y_m += peak.offset.y();
  result.T_reference_body.yaw_rad = common::wrapAngle(pose.yaw_rad + peak.offset.z());
  result.failed = !converged || result.quality < ScanMatcher::kMinQuality ||
                  result.points_used < ScanMatcher::kMinPoints ||
                  !(leastSupport(equations, pose.yaw_rad) > kMinDirectionSupport);
  judgeWindow(result);
  return result;
}

}  // namespace swiftlet::perception
