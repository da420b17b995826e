#include "perception/slam2d/particle/map_match.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "perception/scan_matching/least_squares_match.hpp"

namespace swiftlet::perception {
namespace {

using common::CellIndex;
using common::Pose2;

/// Points of a scan that are matched, spread evenly along its contour.
constexpr int kMatchedPoints = 180;
/// Points that are matched while they are still far from the surfaces they belong to.
constexpr int kCoarsePoints = 60;
/// Where the motion may have slipped, a surface is searched this far along the normal of a point.
constexpr double kReach_m = 0.30;
/// Where the motion has not slipped, a surface is searched this near a point.
constexpr double kSupport_m = 0.08;
/// With a greater share of points on a surface the motion has not slipped.
constexpr double kEnoughSupport = 0.7;
/// Greatest number of steps.
constexpr int kIterations = 10;
/// Least distance of a point from its surface that the weights assume.
constexpr double kResidual_m = 0.02;
/// Factor on the covariance of independent points, which neighbouring ones are not.
constexpr double kCovarianceScale = 2.0;
/// Degrees of freedom of the Student t distribution of the motion: the motion's covariance does not include slips
/// (docs/decisions/slam.md#016).
constexpr double kMotionFreedom = 3.0;
/// Spread, in the likelihood, of end points about the surfaces of a good map.
constexpr double kBeamSigma_m = 0.05;
/// Share of end points on what is not in the map.
constexpr double kOutlierShare = 0.1;
/// Number of independent beams that a scan counts for (measured: docs/decisions/slam.md#016).
constexpr double kIndependentBeams = 20.0;

/// Least cosine between the normals of a point and of its surface. Other surfaces are ignored: the far side of a wall.
constexpr double kSameSide = 0.5;
/// The reach shrinks by this factor each step. It starts wide, so that walls that do not fit yet take part too.
constexpr double kShrink = 0.6;
/// Steps smaller than this end the search.
constexpr double kSmallStep_m = 0.0005;
/// Least lever arm by which rotations are compared with translations.
constexpr double kLeastLever_m = 0.5;
constexpr int kDimensions = 3;

/// A surface of the map that a point lies on or near.
struct Surface {
  Eigen::Vector2d point_m, normal;
};

class Matching {
 public:
  Matching(const SurfaceMap& map, const std::vector<OrientedPoint>& points, const UncertainPose& prior)
      : map_(map), points_(points), prior_(prior), information_(prior.covariance.inverse()) {
    double lever2 = 0.0;
    for (const OrientedPoint& p : points) lever2 += static_cast<double>(p.point_m.squaredNorm());
    lever_m_ =
        std::max(kLeastLever_m, std::sqrt(lever2 / static_cast<double>(std::max<std::size_t>(points.size(), 1))));
  }

  MapMatch run() const;

 private:
  /// How the scan fits the map at one pose.
  struct View {
    NormalEquations equations;
    double log_sum = 0.0;          ///< Sum over the evaluated points.
    double beams_per_point = 1.0;  ///< Beams that each evaluated point stands for.
  };

  std::optional<Surface> surfaceIn(CellIndex index, const Eigen::Vector2d& normal) const;
  std::optional<Surface> surfaceAlong(const Eigen::Vector2d& at_m, const Eigen::Vector2d& normal, double reach_m) const;
  std::optional<Surface> surfaceNear(const Eigen::Vector2d& at_m, const Eigen::Vector2d& normal) const;
  View viewFrom(const Pose2& pose, double reach_m) const;
  Eigen::Vector3d offset(const Pose2& pose) const;
  double motionTrust(const Pose2& pose) const;
  Eigen::Matrix3d scanInformation(const NormalEquations& equations, double residual2_m2) const;
  Pose2 refine(double reach_m) const;
  MapMatch evaluate(const Pose2& pose) const;

  const SurfaceMap& map_;
  const std::vector<OrientedPoint>& points_;
  const UncertainPose& prior_;
  Eigen::Matrix3d information_;
  double lever_m_ = 1.0;
};

std::optional<Surface> Matching::surfaceIn(CellIndex index, const Eigen::Vector2d& normal) const {
  const SurfaceCell cell = map_.at(index);
  if (!cell.isOccupied()) return std::nullopt;
  const Eigen::Vector2d facing(cell.normal_x, cell.normal_y);
  if (facing.dot(normal) < kSameSide * 127.0) return std::nullopt;
  return Surface{map_.surface_m(index, cell), facing.normalized()};
}

/// The nearest surface on the line through the point along its normal.
std::optional<Surface> Matching::surfaceAlong(const Eigen::Vector2d& at_m, const Eigen::Vector2d& normal,
                                              double reach_m) const {
  const double step_m = map_.resolution_m();
  for (double distance_m = 0.0; distance_m <= reach_m; distance_m += step_m) {
    std::optional<Surface> nearest;
    for (const double side : {1.0, -1.0}) {
      const auto surface = surfaceIn(map_.cellAt(at_m + side * distance_m * normal), normal);
      if (!surface) continue;
      if (!nearest || (surface->point_m - at_m).squaredNorm() < (nearest->point_m - at_m).squaredNorm())
        nearest = surface;
    }
    if (nearest) return nearest;
  }
  return std::nullopt;
}

/// The nearest surface in the cell of the point and in the cells around it.
std::optional<Surface> Matching::surfaceNear(const Eigen::Vector2d& at_m, const Eigen::Vector2d& normal) const {
  const CellIndex middle = map_.cellAt(at_m);
  std::optional<Surface> nearest;
  double nearest2 = kSupport_m * kSupport_m;
  for (int y = middle.y - 1; y <= middle.y + 1; ++y) {
    for (int x = middle.x - 1; x <= middle.x + 1; ++x) {
      const auto surface = surfaceIn({x, y}, normal);
      if (!surface) continue;
      const double distance2 = (surface->point_m - at_m).squaredNorm();
      if (distance2 > nearest2) continue;
      nearest2 = distance2;
      nearest = surface;
    }
  }
  return nearest;
}

Matching::View Matching::viewFrom(const Pose2& pose, double reach_m) const {
  const bool fine = reach_m <= kSupport_m;
  const std::size_t stride =
      fine ? 1 : std::max<std::size_t>(1, points_.size() / static_cast<std::size_t>(kCoarsePoints));
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(pose.yaw_rad).toRotationMatrix();
  View view;
  view.beams_per_point = static_cast<double>(stride);
  for (std::size_t i = 0; i < points_.size(); i += stride) {
    const Eigen::Vector2d arm_m = R * points_[i].foot_m.cast<double>(), at_m = pose.position_m() + arm_m;
    const Eigen::Vector2d normal = R * points_[i].normal.cast<double>();
    const auto surface = fine ? surfaceNear(at_m, normal) : surfaceAlong(at_m, normal, reach_m);
    double fit = 0.0;
    if (surface) {
      const double distance_m = surface->normal.dot(at_m - surface->point_m);
      const double sigmas = distance_m / kBeamSigma_m;
      fit = std::exp(-0.5 * sigmas * sigmas);
      view.equations.add(arm_m, surface->normal, distance_m * surface->normal, 1.0 / lever_m_);
    }
    view.log_sum += std::log((1.0 - kOutlierShare) * fit + kOutlierShare);
  }
  return view;
}

Eigen::Vector3d Matching::offset(const Pose2& pose) const {
  return {pose.x_m - prior_.T_map_body.x_m, pose.y_m - prior_.T_map_body.y_m,
          common::wrapAngle(pose.yaw_rad - prior_.T_map_body.yaw_rad)};
}

/// The weight of a Gaussian that replaces the motion's Student t distribution: small where the motion was clearly
/// wrong.
double Matching::motionTrust(const Pose2& pose) const {
  const Eigen::Vector3d off = offset(pose);
  const double freedom = kMotionFreedom;
  return std::min(1.0, (freedom + kDimensions) / (freedom + off.dot(information_ * off)));
}

/// The information of (x_m, y_m, yaw_rad) from points with this mean squared distance from the surfaces.
Eigen::Matrix3d Matching::scanInformation(const NormalEquations& e, double residual2_m2) const {
  Eigen::Matrix3d curvature;
  curvature << e.xx, e.xy, e.xt, e.xy, e.yy, e.yt, e.xt, e.yt, e.tt;
  const Eigen::Vector3d units(1.0, 1.0, lever_m_);
  return units.asDiagonal() * curvature * units.asDiagonal() / (residual2_m2 * kCovarianceScale);
}

/// Gauss-Newton from the predicted pose, with a reach that shrinks.
Pose2 Matching::refine(double reach_m) const {
  const double residual2_m2 = kResidual_m * kResidual_m;
  Pose2 pose = prior_.T_map_body;
  for (int i = 0; i < kIterations; ++i) {
    const bool fine = reach_m <= kSupport_m;
    const View view = viewFrom(pose, reach_m);
    const NormalEquations& e = view.equations;
    const Eigen::Vector3d pull =
        view.beams_per_point / (residual2_m2 * kCovarianceScale) * Eigen::Vector3d(e.x, e.y, lever_m_ * e.t);
    const Eigen::Matrix3d motion = motionTrust(pose) * information_;
    const Eigen::Matrix3d H = view.beams_per_point * scanInformation(e, residual2_m2) + motion;
    const Eigen::Vector3d step = -H.ldlt().solve(pull + motion * offset(pose));
    pose = {pose.x_m + step.x(), pose.y_m + step.y(), common::wrapAngle(pose.yaw_rad + step.z())};
    reach_m = std::max(kSupport_m, kShrink * reach_m);
    if (fine && step.head<2>().norm() + lever_m_ * std::abs(step.z()) < kSmallStep_m) break;
  }
  return pose;
}

MapMatch Matching::evaluate(const Pose2& pose) const {
  const View view = viewFrom(pose, kSupport_m);
  const NormalEquations& e = view.equations;
  const double residual2_m2 = std::max(e.squares_m2 / std::max(e.count, 1), kResidual_m * kResidual_m);
  const auto count = static_cast<double>(std::max<std::size_t>(points_.size(), 1));
  const Eigen::Vector3d off = offset(pose);
  const double freedom = kMotionFreedom;
  MapMatch match;
  match.T_map_body = pose;
  match.covariance = (scanInformation(e, residual2_m2) + motionTrust(pose) * information_).inverse();
  match.support = e.count / count;
  match.log_likelihood = kIndependentBeams * view.log_sum / count;
  match.log_motion = -0.5 * (freedom + kDimensions) * std::log1p(off.dot(information_ * off) / freedom);
  return match;
}

/// Usually the predicted motion is right, and a search near it is enough. If the scan then lacks support, the motion
/// has slipped or the area is new: a wide search is tried too, and the likelier result is returned.
MapMatch Matching::run() const {
  MapMatch near = evaluate(refine(kSupport_m));
  if (near.support > kEnoughSupport) return near;
  const MapMatch far = evaluate(refine(kReach_m));
  return far.log_likelihood + far.log_motion > near.log_likelihood + near.log_motion ? far : near;
}

}  // namespace

std::vector<OrientedPoint> pointsToMatch(const ProjectedScan& scan) {
  return orientedPoints(scan, kMatchedPoints, SurfaceMap::kMaxGap_m, ScanMatcher::kMaxRange_m);
}

MapMatch matchToMap(const SurfaceMap& map, const std::vector<OrientedPoint>& points, const UncertainPose& prior) {
  return Matching(map, points, prior).run();
}

}  // namespace swiftlet::perception
