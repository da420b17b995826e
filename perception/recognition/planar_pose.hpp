// The pose of a plane from what a pinhole camera shows of it.
//
// Inside of the room poses are those of the plane in the optical frame: x right, y down, z along the view, which is
// that of the published formulas.
#pragma once

#include <array>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"

namespace swiftlet::perception {

/// point_optical = rotation * (x, y, 0) + position.
struct PlanarPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position_m = Eigen::Vector3d::UnitZ();

  Eigen::Vector3d operator*(const Eigen::Vector2d& point_m) const {
    return rotation.leftCols<2>() * point_m + position_m;
  }
  /// Whether the camera sees its face: the side to which z points.
  bool showsFace() const { return rotation.col(2).dot(position_m) < 0.0; }
};

/// The pose in the frame `camera` of docs/conventions.md, and the rotation between the two.
common::Pose3 T_camera_plane(const PlanarPose& pose);
PlanarPose planarPose(const common::Pose3& T_camera_plane);
/// Covariance of (rotation, position) from the axes of the optical frame to those of `camera`.
Eigen::Matrix<double, 6, 6> inCameraAxes(const Eigen::Matrix<double, 6, 6>& covariance_optical);

Eigen::Vector2d pixelOf(const common::PinholeCamera& camera, const Eigen::Vector3d& point_optical_m);

/// How the pixel of a point moves with (rotation vector, position): pose = (exp(rotation) * R, t + position).
using PixelJacobian = Eigen::Matrix<double, 2, 6>;
PixelJacobian pixelJacobian(const common::PinholeCamera& camera, const PlanarPose& pose,
                            const Eigen::Vector3d& point_optical_m);
PlanarPose moved(const PlanarPose& pose, const Eigen::Matrix<double, 6, 1>& step);

/// A point of the plane and the pixel that shows it.
struct PlanarMatch {
  Eigen::Vector2d point_m;
  Eigen::Vector2d pixel;
};

/// The homography from points to pixels that fits best algebraically (R. Hartley, A. Zisserman, "Multiple View
/// Geometry", algorithm 4.2, with normalized coordinates). None for fewer than four or collinear points.
std::optional<Eigen::Matrix3d> homographyOf(std::span<const PlanarMatch> matches);

/// An affine map from the plane to pixels: pixel = linear * point + pixel of the origin.
struct AffineMap {
  Eigen::Matrix2d linear;
  Eigen::Vector2d origin_px;
  Eigen::Vector2d operator*(const Eigen::Vector2d& point_m) const { return linear * point_m + origin_px; }
};
/// A homography's first-order expansion at a point of the plane, which becomes the origin of the map's points.
AffineMap expandedAt(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point_m);

/// The two poses whose projection has that first-order expansion at `anchor_m` (T. Collins, A. Bartoli, "Infinitesimal
/// plane-based pose estimation", IJCV 2014, section 4.2): from far away a plane and its mirror image look the same.
/// None for a map that is degenerate.
std::optional<std::array<PlanarPose, 2>> infinitesimalPoses(const common::PinholeCamera& camera, const AffineMap& map,
                                                            const Eigen::Vector2d& anchor_m);

/// A pose fitted to matches by least squares on pixels.
struct FittedPose {
  PlanarPose pose;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();  ///< For errors of 1 px.
  double rms_px = 0.0;  ///< Of one coordinate of a pixel, by the degrees of freedom that are left.
};
FittedPose fitPose(const common::PinholeCamera& camera, std::span<const PlanarMatch> matches, const PlanarPose& start);
/// The better of the two that `infinitesimalPoses` gives for the best homography.
std::optional<FittedPose> fitPose(const common::PinholeCamera& camera, std::span<const PlanarMatch> matches);

}  // namespace swiftlet::perception
