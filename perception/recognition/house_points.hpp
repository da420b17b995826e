// What of a depth image may be a house: the ground, and what stands on it apart from everything else.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "perception/recognition/house_model.hpp"
#include "perception/recognition/wall_planes.hpp"

namespace swiftlet::perception {

/// A measured point, in the axes of the level camera.
struct HousePoint {
  Eigen::Vector3d at_m;
  double sigma_m;  ///< Along the ray.
};

/// The height of the ground: the lowest level on which much of the picture lies, and below which next to nothing does;
/// nullopt if there is none, as where the ground returns too little to be measured.
std::optional<double> groundOf(const std::vector<HousePoint>& points);
/// Every third pixel of every third row.
std::vector<HousePoint> housePoints(const DepthView& view);
/// Groups of points above the ground that are apart from each other, the greatest first. What rises above the chimney,
/// such as the wall of a hall, is left out.
std::vector<std::vector<HousePoint>> standingGroups(const std::vector<HousePoint>& points, double ground_m,
                                                    const HouseModel& model);

}  // namespace swiftlet::perception
