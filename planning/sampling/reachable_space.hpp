// What the hull can reach from a place, cell by cell through what is free: it tells a goal that is walled in from one
// that samples have not found a path to, and has that path.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "planning/clearance/clearance.hpp"

namespace swiftlet::planning {

/// The cells with at least `radius_m` that moves along the axes reach from a place, the nearest first. `clearance` must
/// outlive it.
class ReachableSpace {
 public:
  /// Ends where `until_map_m`, if given, is reached. Nothing is reached from a place that is not free.
  ReachableSpace(const Clearance& clearance, const Eigen::Vector3d& from_map_m, double radius_m,
                 const std::optional<Eigen::Vector3d>& until_map_m = std::nullopt);

  bool reaches(const Eigen::Vector3d& place_map_m) const;
  /// The centres of the cells from the first to that of a place that is reached.
  std::vector<Eigen::Vector3d> pathTo(const Eigen::Vector3d& place_map_m) const;
  /// The centre of the reached cell that is nearest to a place; nullopt if none is reached.
  std::optional<Eigen::Vector3d> nearestTo(const Eigen::Vector3d& place_map_m) const;

 private:
  common::VoxelIndex cellOf(const Eigen::Vector3d& place_map_m) const;
  Eigen::Vector3d centerOf(std::size_t index) const;
  /// nullopt outside.
  std::optional<std::size_t> indexOf(common::VoxelIndex cell) const;
  void spread(std::size_t first, double radius_m, std::optional<std::size_t> until);

  const Clearance& clearance_;
  common::VoxelIndex size_;
  std::vector<std::uint8_t> step_;    ///< By which step a cell was reached; kNotReached.
  std::vector<std::size_t> reached_;  ///< In that order.
};

/// The free place nearest to one, within a distance; its cell's centre. nullopt without one.
std::optional<Eigen::Vector3d> nearestFreePlace(const Clearance& clearance, const Eigen::Vector3d& place_map_m,
                                                double radius_m, double within_m);

}  // namespace swiftlet::planning
