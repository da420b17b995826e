// Walls in a depth image: upright planes. Candidates are the maxima of a Hough transform over heading and distance (R.
// Duda, P. Hart, "Use of the Hough transformation to detect lines and curves in pictures", Comm. ACM 1972) of pixels
// whose neighbours above and below stand upright with them; each is fitted in inverse depth, in which the noise of a
// camera that measures disparities is equal everywhere (Khoshelham and Elberink 2012) and a plane is linear.
//
// Coordinates are those of the level camera: its origin, axes turned so that z points up.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/rgbd_frame.hpp"

namespace swiftlet::perception {

/// A depth image with its attitude. Refers to both; a value for the time of a call.
struct DepthView {
  const common::PinholeCamera& camera;
  const common::DepthImage& depth;
  Eigen::Matrix3d R_level_camera;
  double inverse_depth_sigma_1_m;  ///< Standard deviation of a pixel, noise and steps together.
  double range_max_m;              ///< What is beyond is reported as too far.

  /// The direction of a pixel; its component along the view is 1, so that depth times it is the point.
  Eigen::Vector3d ray(double u_px, double v_px) const {
    return R_level_camera * camera.point_camera_m(u_px, v_px, 1.0);
  }
};

/// All points with inverse_1_m . point = 1: the normal, pointing away from the camera, over the distance.
struct WallPlane {
  Eigen::Vector3d inverse_1_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_1_m2 = Eigen::Matrix3d::Zero();

  double distance_m() const { return 1.0 / inverse_1_m.norm(); }
  Eigen::Vector3d normal() const { return inverse_1_m.normalized(); }
  /// Horizontal, along the wall to the right as the camera sees it.
  Eigen::Vector3d right() const { return inverse_1_m.cross(Eigen::Vector3d::UnitZ()).normalized(); }
};

/// The greatest first. The same view gives the same bits.
std::vector<WallPlane> findWalls(const DepthView& view);

}  // namespace swiftlet::perception
