// The certificate of an exploration: whether all that could be seen was seen when `Explore` ended as a success, by a
// flood of the true world, of which the autonomy knows nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "evaluation/behavior_recorder.hpp"
#include "evaluation/true_world.hpp"

namespace swiftlet::evaluation {

/// Connected cells that were not seen.
struct UnseenPlace {
  Eigen::Vector2d center_map_m = Eigen::Vector2d::Zero();
  double height_m = 0.0;  ///< Over the take-off floor; of an area the height of flight.
  double amount = 0.0;    ///< In square metres, or cubic metres of a volume.
};

struct ExploredCheck {
  double amount = 0.0;  ///< That could be seen, in square or cubic metres.
  double unseen_share = 0.0;
  std::vector<UnseenPlace> left;  ///< What was not seen, the greatest first; single cells are not listed.
};

struct ExploredChecks {
  /// Of the area that the hull could cover, by the truth, at the height of flight and with the clearance that was asked
  /// for, what the map did not have. Nobody stands in its way, since people may go. nullopt if the world is open, if
  /// there were keep-out zones, which the flood does not know, or if the hull hardly fits where it took off.
  std::optional<ExploredCheck> area;
  /// Of the volume that an ideal camera could see from the reachable places, at the height of flight, in any direction
  /// and within its range, what the 3D map did not have. nullopt as above, or without a depth camera or a 3D map.
  std::optional<ExploredCheck> volume;
};

ExploredChecks checkExplored(const BehaviorRecord::Explored& explored, const TrueWorld& world,
                             const common::Pose3& T_world_map);

/// For people: "explored: all of 93.4 m2 reachable was seen", or what is left and where.
std::string certificateOf(const std::optional<ExploredCheck>& area, const std::optional<ExploredCheck>& volume);

}  // namespace swiftlet::evaluation
