// Fits the shape of a known house to points that may be it: principal component analysis for where to begin, and
// iterative closest points, to planes, from there (Tomic 2012, section "Recognition"; the distance to planes is that of
// Y. Chen, G. Medioni, "Object modelling by registration of multiple range images", 1992).
//
//   points --> the directions in which the roof spreads --> starts: two headings, three middles --> ICP --> poses, the
//   best first
//
// Gravity is known, so a pose has four degrees of freedom. The shape does not tell one end of the house from the other.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "perception/recognition/house_model.hpp"
#include "perception/recognition/house_points.hpp"

namespace swiftlet::perception {

/// The middle of the floor and the heading of the ridge, in the axes of the level camera.
struct HousePose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< Of x, y, z and yaw.
  double fit = 0.0;                                      ///< Share of the points that lie on the shape.

  Eigen::Vector3d inHouse_m(const Eigen::Vector3d& point_level_m) const {
    return Eigen::AngleAxisd(-yaw_rad, Eigen::Vector3d::UnitZ()) * (point_level_m - position_m);
  }
  Eigen::Vector3d inLevel_m(const Eigen::Vector3d& point_house_m) const {
    return position_m + Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * point_house_m;
  }
};

/// All that differ, the one that fits most points first; empty if there are too few points.
std::vector<HousePose> fitHouse(const HouseModel& model, const std::vector<HousePoint>& points, double ground_m);

}  // namespace swiftlet::perception
