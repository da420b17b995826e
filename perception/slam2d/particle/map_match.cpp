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
  Matching(const SurfaceMap& map, const std::vector<OrientedPoint>& points, const MotionPrior& prior,
           const MapMatchConfig& config)
      : map_(map), points_(points), prior_(prior), config_(config), information_(prior.covariance.inverse()) {
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
  const MotionPrior& prior_;
  const MapMatchConfig& config_;
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
  double nearest2 = config_.support_m * config_.support_m;
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
  const bool fine = reach_m <= config_.support_m;
  const std::size_t stride =
      fine ? 1 : std::max<std::size_t>(1, points_.size() / static_cast<std::size_t>(config_.coarse_points));
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
      const double sigmas = distance_m / config_.beam_sigma_m;
      fit = std::exp(-0.5 * sigmas * sigmas);
      view.equations.add(arm_m, surface->normal, distance_m * surface->normal, 1.0 / lever_m_);
    }
    view.log_sum += std::log((1.0 - config_.outlier_share) * fit + config_.outlier_share);
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
  const double freedom = config_.motion_freedom;
  return std::min(1.0, (freedom + kDimensions) / (freedom + off.dot(information_ * off)));
}

/// The information of (x_m, y_m, yaw_rad) from points with this mean squared distance from the surfaces.
Eigen::Matrix3d Matching::scanInformation(const NormalEquations& e, double residual2_m2) const {
  Eigen::Matrix3d curvature;
  curvature << e.xx, e.xy, e.xt, e.xy, e.yy, e.yt, e.xt, e.yt, e.tt;
  const Eigen::Vector3d units(1.0, 1.0, lever_m_);
  return units.asDiagonal() * curvature * units.asDiagonal() / (residual2_m2 * config_.covariance_scale);
}

/// Gauss-Newton from the predicted pose, with a reach that shrinks.
Pose2 Matching::refine(double reach_m) const {
  const double residual2_m2 = config_.residual_m * config_.residual_m;
  Pose2 pose = prior_.T_map_body;
  for (int i = 0; i < config_.iterations; ++i) {
    const bool fine = reach_m <= config_.support_m;
    const View view = viewFrom(pose, reach_m);
    const NormalEquations& e = view.equations;
    const Eigen::Vector3d pull =
        view.beams_per_point / (residual2_m2 * config_.covariance_scale) * Eigen::Vector3d(e.x, e.y, lever_m_ * e.t);
    const Eigen::Matrix3d motion = motionTrust(pose) * information_;
    const Eigen::Matrix3d H = view.beams_per_point * scanInformation(e, residual2_m2) + motion;
    const Eigen::Vector3d step = -H.ldlt().solve(pull + motion * offset(pose));
    pose = {pose.x_m + step.x(), pose.y_m + step.y(), common::wrapAngle(pose.yaw_rad + step.z())};
    reach_m = std::max(config_.support_m, kShrink * reach_m);
    if (fine && step.head<2>().norm() + lever_m_ * std::abs(step.z()) < kSmallStep_m) break;
  }
  return pose;
}

MapMatch Matching::evaluate(const Pose2& pose) const {
  const View view = viewFrom(pose, config_.support_m);
  const NormalEquations& e = view.equations;
  const double residual2_m2 = std::max(e.squares_m2 / std::max(e.count, 1), config_.residual_m * config_.residual_m);
  const auto count = static_cast<double>(std::max<std::size_t>(points_.size(), 1));
  const Eigen::Vector3d off = offset(pose);
  const double freedom = config_.motion_freedom;
  MapMatch match;
  match.T_map_body = pose;
  match.covariance = (scanInformation(e, residual2_m2) + motionTrust(pose) * information_).inverse();
  match.support = e.count / count;
  match.log_likelihood = config_.independent_beams * view.log_sum / count;
  match.log_motion = -0.5 * (freedom + kDimensions) * std::log1p(off.dot(information_ * off) / freedom);
  return match;
}

/// Usually the predicted motion is right, and a search near it is enough. If the scan then lacks support, the motion
/// has slipped or the area is new: a wide search is tried too, and the likelier result is returned.
MapMatch Matching::run() const {
  MapMatch near = evaluate(refine(config_.support_m));
  if (near.support > config_.enough_support) return near;
  const MapMatch far = evaluate(refine(config_.reach_m));
  return far.log_likelihood + far.log_motion > near.log_likelihood + near.log_motion ? far : near;
}

}  // namespace

std::vector<OrientedPoint> pointsToMatch(const ProjectedScan& scan, const MapMatchConfig& config, double max_gap_m) {
  return orientedPoints(scan, config.points, max_gap_m, config.max_range_m);
}

MapMatch matchToMap(const SurfaceMap& map, const std::vector<OrientedPoint>& points, const MotionPrior& prior,
                    const MapMatchConfig& config) {
  return Matching(map, points, prior, config).run();
}

}  // namespace swiftlet::perception
