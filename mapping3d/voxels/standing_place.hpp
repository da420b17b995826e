// Where in a free space a vehicle can stand and take off.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "mapping3d/voxels/free_space.hpp"

namespace swiftlet::mapping3d {

/// The upright cylinder that must be free, and the disc in its bottom that must be level.
struct StandingRoom {
  double radius_m = 0.375;
  double height_m = 1.225;
  double feet_radius_m = 0.15;
};

struct StandingPlace {
  Eigen::Vector3d floor_m = Eigen::Vector3d::Zero();  ///< On the floor.
  double ceiling_m = 0.0;                             ///< Where the free part above it ends.
  /// Something was measured there; otherwise what is known to be free ends there.
  bool floor_measured = false;
  bool ceiling_measured = false;
};

/// The floor of the voxel column at a place: of the lowest free part that is as high as the room, or of the part in
/// which the given height is. nullopt without one, and where the space is open below.
std::optional<StandingPlace> floorAt(const FreeSpace& space, const Eigen::Vector2d& at_m, const StandingRoom& room,
                                     std::optional<double> height_m);

/// The same for the column nearest to a place, within a radius, in which that floor was measured.
std::optional<StandingPlace> measuredFloorNear(const FreeSpace& space, const Eigen::Vector2d& at_m,
                                               const StandingRoom& room, std::optional<double> height_m,
                                               double radius_m);

/// The place nearest to the wanted one that has the room, within a tenth of a metre. nullopt if there is none.
std::optional<StandingPlace> nearestStandingPlace(const FreeSpace& space, const Eigen::Vector2d& wanted_m,
                                                  const StandingRoom& room);

}  // namespace swiftlet::mapping3d
