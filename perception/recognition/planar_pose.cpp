#include "perception/recognition/planar_pose.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace swiftlet::perception {
namespace {

/// Columns are the axes of the optical frame in `camera`: x right, y down, z along the view.
const Eigen::Matrix3d& opticalAxes() {
  static const Eigen::Matrix3d kAxes = (Eigen::Matrix3d() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0).finished();
  return kAxes;
}

/// Moves the mean to 0 and the mean distance to sqrt(2).
Eigen::Matrix3d normalizing(const Eigen::Vector2d& mean, double mean_distance) {
  const double scale = std::sqrt(2.0) / mean_distance;
  Eigen::Matrix3d transform = Eigen::Matrix3d::Identity();
  transform(0, 0) = transform(1, 1) = scale;
  transform.topRightCorner<2, 1>() = -scale * mean;
  return transform;
}

/// The rotation that turns the view's axis to the direction of (x, y, 1) by the shortest way.
Eigen::Matrix3d rotationTo(const Eigen::Vector2d& ray) {
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), Eigen::Vector3d(ray.x(), ray.y(), 1.0))
      .toRotationMatrix();
}

constexpr int kPoseIterations = 15;
constexpr double kPoseConverged = 1e-10;

double squaredError(const common::PinholeCamera& camera, std::span<const PlanarMatch> matches, const PlanarPose& pose) {
  double sum = 0.0;
  for (const PlanarMatch& match : matches) {
    const Eigen::Vector3d point = pose * match.point_m;
    if (point.z() <= 0.0) return INFINITY;
    sum += (match.pixel - pixelOf(camera, point)).squaredNorm();
  }
  return sum;
}

}  // namespace

common::Pose3 T_camera_plane(const PlanarPose& pose) {
  return {Eigen::Quaterniond(Eigen::Matrix3d(opticalAxes() * pose.rotation)).normalized(),
          opticalAxes() * pose.position_m};
}

PlanarPose planarPose(const common::Pose3& T_camera_plane) {
  return {opticalAxes().transpose() * T_camera_plane.rotation.toRotationMatrix(),
          opticalAxes().transpose() * T_camera_plane.position_m};
}

Eigen::Matrix<double, 6, 6> inCameraAxes(const Eigen::Matrix<double, 6, 6>& covariance_optical) {
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = opticalAxes();
  return turn * covariance_optical * turn.transpose();
}

Eigen::Vector2d pixelOf(const common::PinholeCamera& camera, const Eigen::Vector3d& point_optical_m) {
  return {camera.cx_px + camera.fx_px * point_optical_m.x() / point_optical_m.z(),
          camera.cy_px + camera.fy_px * point_optical_m.y() / point_optical_m.z()};
}

PixelJacobian pixelJacobian(const common::PinholeCamera& camera, const PlanarPose& pose,
                            const Eigen::Vector3d& point_optical_m) {
  const double inverse = 1.0 / point_optical_m.z();
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << camera.fx_px * inverse, 0.0, -camera.fx_px * point_optical_m.x() * inverse * inverse, 0.0,
      camera.fy_px * inverse, -camera.fy_px * point_optical_m.y() * inverse * inverse;
  PixelJacobian jacobian;
  jacobian.leftCols<3>() = -by_point * common::skew(point_optical_m - pose.position_m);
  jacobian.rightCols<3>() = by_point;
  return jacobian;
}

PlanarPose moved(const PlanarPose& pose, const Eigen::Matrix<double, 6, 1>& step) {
  return {common::expSO3(step.head<3>()).toRotationMatrix() * pose.rotation, pose.position_m + step.tail<3>()};
}

std::optional<Eigen::Matrix3d> homographyOf(std::span<const PlanarMatch> matches) {
  if (matches.size() < 4) return std::nullopt;
  const double count = static_cast<double>(matches.size());
  Eigen::Vector2d mean_m = Eigen::Vector2d::Zero(), mean_px = Eigen::Vector2d::Zero();
  for (const PlanarMatch& match : matches) {
    mean_m += match.point_m / count;
    mean_px += match.pixel / count;
  }
  double distance_m = 0.0, distance_px = 0.0;
  for (const PlanarMatch& match : matches) {
    distance_m += (match.point_m - mean_m).norm() / count;
    distance_px += (match.pixel - mean_px).norm() / count;
  }
  if (!(distance_m > 0.0 && distance_px > 0.0)) return std::nullopt;
  const Eigen::Matrix3d from = normalizing(mean_m, distance_m), to = normalizing(mean_px, distance_px);
  Eigen::Matrix<double, 9, 9> squares = Eigen::Matrix<double, 9, 9>::Zero();
  for (const PlanarMatch& match : matches) {
    const Eigen::Vector3d x = from * match.point_m.homogeneous();
    const Eigen::Vector3d y = to * match.pixel.homogeneous();
    Eigen::Matrix<double, 2, 9> rows = Eigen::Matrix<double, 2, 9>::Zero();
    rows.block<1, 3>(0, 0) = x.transpose();
    rows.block<1, 3>(0, 6) = -y.x() * x.transpose();
    rows.block<1, 3>(1, 3) = x.transpose();
    rows.block<1, 3>(1, 6) = -y.y() * x.transpose();
    squares += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(squares);
  // A second small eigenvalue: three of four points are collinear, so that many homographies fit.
  if (!(solver.eigenvalues()[1] > 1e-9 * solver.eigenvalues()[8])) return std::nullopt;
  const Eigen::Matrix<double, 9, 1> h = solver.eigenvectors().col(0);
  Eigen::Matrix3d normalized;
  normalized << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8];
  Eigen::Matrix3d homography = to.inverse() * normalized * from;
  if (!homography.allFinite() || std::abs(homography(2, 2)) < 1e-12) return std::nullopt;
  return homography / homography(2, 2);
}

AffineMap expandedAt(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point_m) {
  const Eigen::Vector3d image = homography * point_m.homogeneous();
  AffineMap map;
  map.origin_px = image.hnormalized();
  map.linear = (homography.topLeftCorner<2, 2>() - map.origin_px * homography.bottomLeftCorner<1, 2>()) / image.z();
  return map;
}

std::optional<std::array<PlanarPose, 2>> infinitesimalPoses(const common::PinholeCamera& camera, const AffineMap& map,
                                                            const Eigen::Vector2d& anchor_m) {
  const Eigen::Vector2d v((map.origin_px.x() - camera.cx_px) / camera.fx_px,
                          (map.origin_px.y() - camera.cy_px) / camera.fy_px);
  Eigen::Matrix2d J = map.linear;
  J.row(0) /= camera.fx_px;
  J.row(1) /= camera.fy_px;
  const Eigen::Matrix3d R_v = rotationTo(v);
  Eigen::Matrix<double, 2, 3> to_plane;
  to_plane << 1.0, 0.0, -v.x(), 0.0, 1.0, -v.y();
  const Eigen::Matrix2d B = to_plane * R_v.leftCols<2>();
  const Eigen::Matrix2d A = B.inverse() * J;
  // gamma is the largest singular value of A, the inverse of the depth.
  const Eigen::Matrix2d squares = A.transpose() * A;
  const double half_trace = 0.5 * squares.trace();
  const double gamma_squared = half_trace + std::sqrt(std::max(0.0, half_trace * half_trace - squares.determinant()));
  if (!(gamma_squared > 0.0) || !std::isfinite(gamma_squared) || A.determinant() == 0.0) return std::nullopt;
  const double gamma = std::sqrt(gamma_squared);
  const Eigen::Matrix2d upper = A / gamma;
  // The third row b completes both columns to unit length and makes them orthogonal.
  const Eigen::Matrix2d rest = Eigen::Matrix2d::Identity() - upper.transpose() * upper;
  Eigen::RowVector2d b(std::sqrt(std::max(0.0, rest(0, 0))), std::sqrt(std::max(0.0, rest(1, 1))));
  if (rest(0, 1) < 0.0) b.y() = -b.y();
  std::array<PlanarPose, 2> poses;
  for (std::size_t i = 0; i < 2; ++i) {
    Eigen::Matrix3d tilted;
    tilted.topLeftCorner<2, 2>() = upper;
    tilted.bottomLeftCorner<1, 2>() = i == 0 ? b : Eigen::RowVector2d(-b);
    tilted.col(2) = tilted.col(0).cross(tilted.col(1));
    poses[i].rotation = Eigen::Quaterniond(Eigen::Matrix3d(R_v * tilted)).normalized().toRotationMatrix();
    poses[i].position_m = Eigen::Vector3d(v.x(), v.y(), 1.0) / gamma - poses[i].rotation.leftCols<2>() * anchor_m;
  }
  return poses;
}

FittedPose fitPose(const common::PinholeCamera& camera, std::span<const PlanarMatch> matches, const PlanarPose& start) {
  FittedPose fitted{start, {}, 0.0};
  double error = squaredError(camera, matches, start), damping = 1e-6;
  for (int i = 0; i < kPoseIterations; ++i) {
    Eigen::Matrix<double, 6, 6> H = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> g = Eigen::Matrix<double, 6, 1>::Zero();
    for (const PlanarMatch& match : matches) {
      const Eigen::Vector3d point = fitted.pose * match.point_m;
      const PixelJacobian jacobian = pixelJacobian(camera, fitted.pose, point);
      H += jacobian.transpose() * jacobian;
      g += jacobian.transpose() * (match.pixel - pixelOf(camera, point));
    }
    fitted.information = H;
    Eigen::Matrix<double, 6, 6> damped = H;
    damped.diagonal() *= 1.0 + damping;
    const PlanarPose next = moved(fitted.pose, damped.ldlt().solve(g));
    const double next_error = squaredError(camera, matches, next);
    if (next_error < error) {
      const bool is_done = error - next_error < kPoseConverged * error;
      fitted.pose = next;
      error = next_error;
      damping *= 0.1;
      if (is_done) break;
    } else {
      damping *= 100.0;
    }
  }
  const double freedom = 2.0 * static_cast<double>(matches.size()) - 6.0;
  fitted.rms_px = std::sqrt(error / std::max(freedom, 1.0));
  return fitted;
}

std::optional<FittedPose> fitPose(const common::PinholeCamera& camera, std::span<const PlanarMatch> matches) {
  const auto homography = homographyOf(matches);
  if (!homography) return std::nullopt;
  Eigen::Vector2d middle_m = Eigen::Vector2d::Zero();
  for (const PlanarMatch& match : matches) middle_m += match.point_m / static_cast<double>(matches.size());
  const auto starts = infinitesimalPoses(camera, expandedAt(*homography, middle_m), middle_m);
  if (!starts) return std::nullopt;
  const FittedPose first = fitPose(camera, matches, (*starts)[0]);
  const FittedPose second = fitPose(camera, matches, (*starts)[1]);
  return first.rms_px <= second.rms_px ? first : second;
}

}  // namespace swiftlet::perception
