// The common part of the matchers that minimize squared distances along normals: the normal equations, one solver step,
// and the final result with its verdict.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "perception/scan_matching/contour_normals.hpp"
#include "perception/scan_matching/quadratic_peak.hpp"
#include "perception/scan_matching/scan_matcher.hpp"

namespace swiftlet::perception {

/// Sums over the matched points at one pose. The unknown is (x, y, turn), each in metres of displacement of the points:
/// `turn` is the rotation times a lever arm.
struct NormalEquations {
  /// Entries of J'J, where J is the derivative of a point's distance by the unknown.
  double xx = 0.0, xy = 0.0, yy = 0.0, xt = 0.0, yt = 0.0, tt = 0.0;
  double x = 0.0, y = 0.0, t = 0.0;  ///< Entries of J'd, where d are the distances.
  double squares_m2 = 0.0;           ///< Sum of d^2.
  int count = 0;
  /// Derivative of J'd by the attitude error, per radian. The columns are for tilts that displace the points along the
  /// x and y axes of the reference. Needed only at the final pose.
  Eigen::Matrix<double, 3, 2> tilt = Eigen::Matrix<double, 3, 2>::Zero();

  /// Adds one point. `arm_m` is the point relative to the body and `normal` that of its contour, both along the
  /// reference axes; `pull_m` is the vector from the contour to the point. Inline because it is the inner loop.
  void add(const Eigen::Vector2d& arm_m, const Eigen::Vector2d& normal, const Eigen::Vector2d& pull_m,
           double inverse_lever) {
    // The point moves by (1, 0) per x, (0, 1) per y, and (-arm_y, arm_x) / lever per turn.
    const double turn_x = -arm_m.y() * inverse_lever, turn_y = arm_m.x() * inverse_lever;
    const double turn = normal.x() * turn_x + normal.y() * turn_y;
    xx += normal.x() * normal.x();
    xy += normal.x() * normal.y();
    yy += normal.y() * normal.y();
    xt += normal.x() * turn;
    yt += normal.y() * turn;
    tt += turn * turn;
    x += pull_m.x();
    y += pull_m.y();
    t += pull_m.x() * turn_x + pull_m.y() * turn_y;
    squares_m2 += pull_m.squaredNorm();
    ++count;
  }
  /// Adds one point to `tilt`: an attitude error moves a point by its height times the error.
  void addTilt(const Eigen::Vector2d& arm_m, const Eigen::Vector2d& normal, double height_m, double inverse_lever);
};

/// The scan to be matched, the guess, and what is the same in every step.
class LeastSquaresMatch {
 public:
  /// Points of a scan that are matched, spread evenly along its contour.
  static constexpr int kPoints = 400;
  /// Neighbouring end points nearer than this are joined to a contour.
  static constexpr double kMaxGap_m = 0.3;
  /// A point farther than this from the reference has no support.
  static constexpr double kSupport_m = 0.06;

  LeastSquaresMatch(const ProjectedScan& scan, const common::Pose2& guess, const SearchWindow& window);

  const std::vector<OrientedPoint>& points() const { return points_; }
  bool hasEnoughPoints() const { return static_cast<int>(points_.size()) >= ScanMatcher::kMinPoints; }
  /// Approximately how far a point of the scan can move within the window.
  double windowReach_m() const { return window_.half_translation_m + window_.half_rotation_rad * lever_m_; }
  double inverseLever() const { return 1.0 / lever_m_; }

  /// Moves the pose to the minimum of the normal equations, by at most `reach_m` along each principal axis. Along
  /// directions that the scan does not constrain, the pose returns to the guess. Returns how far the points moved; NaN
  /// if the equations cannot be solved.
  double step(const NormalEquations& equations, double reach_m, common::Pose2& pose) const;

  /// The result at the pose of the last step. `quality_sum` is the sum of the scores of all points, each in [0, 1].
  /// `converged` says that the last step was small.
  MatchResult finish(const NormalEquations& equations, double quality_sum, bool converged,
                     const common::Pose2& pose) const;

 private:
  Quadratic quadraticAt(const NormalEquations& equations, const std::optional<common::UnobservableMotion>& held) const;
  /// The motion along which the contour slides along itself, along the reference axes; nullopt if there is none.
  std::optional<common::UnobservableMotion> heldMotion(double yaw_rad) const;
  double leastSupport(const NormalEquations& equations, double yaw_rad) const;
  void judgeWindow(MatchResult& result) const;

  std::vector<OrientedPoint> points_;
  common::Pose2 guess_;
  SearchWindow window_;
  double lever_m_ = 1.0;
  std::optional<common::UnobservableMotion> held_level_;
};

}  // namespace swiftlet::perception
