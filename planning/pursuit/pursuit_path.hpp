// The path of the next seconds on which a walking person stays in sight and at the right distance, whatever that
// person is likely to do. Dynamic programming over places and time, with the expected loss over what the person may do
// [LaValle, Gonzalez-Banos, Becker, Latombe 1997, "Motion strategies for maintaining visibility of a moving target"].
#pragma once

#include <span>

#include <Eigen/Core>

#include "common/dynamic_obstacle.hpp"
#include "common/occupancy_grid.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::planning {

/// A distance that is smaller or larger than the wanted one by more than this is wrong. With 0.35 m the vehicle gave
/// way where it had only stopped 5 cm too late (measured: docs/decisions/following.md).
inline constexpr double kPursuitNearer_m = 0.5, kPursuitFarther_m = 0.7;

/// References are read during the call only.
struct PursuitQuestion {
  const CostMap& costs;
  const common::OccupancyGrid& grid;
  Eigen::Vector2d here_map_m;
  std::span<const common::PossibleWalk> walks;  ///< At least one.
  /// Where the person walked lately: the map may still show the person there.
  std::span<const Eigen::Vector2d> walked_map_m;
  double distance_m = 2.0;  ///< To be kept from the person.
  double speed_m_s = 0.7;   ///< Of the vehicle.
};

struct PursuitPath {
  /// From here; one point: it is best to stay. In the lethal zone it begins with the escape from there, which is flown
  /// also if it is best to stay behind it.
  Path path;
  double in_sight = 0.0;  ///< Probability that the person is seen from its end, at the end.
};

/// A pure function; safe from any thread.
PursuitPath pursuitPath(const PursuitQuestion& question);

}  // namespace swiftlet::planning
