// Where the vehicle can set down: the surfaces below are known only along the flown trail, from the beams that look
// down, and the edge of a table or a step beside the place tips the vehicle over.
#pragma once

#include <numbers>
#include <optional>

#include <Eigen/Core>

#include "common/level_map.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

struct LandingNeeds {
  double hull_radius_m = 0.275;
  double margin_m = 0.15;  ///< Between the hull and the nearest surface of another height.
  double reach_m = 4.0;    ///< Greatest length of the flight to the place.

  double aside_m() const { return hull_radius_m + margin_m; }
  /// An edge that runs at 45 deg past the nearest of its points that was seen is nearer by the root of 2.
  double asideAskew_m() const { return std::numbers::sqrt2 * aside_m(); }
};

/// `levels` are the surfaces that were seen; a cell may be in several of them.
/// The place nearest to `from_map_m`, by a path through free cells of `map`, where the surface below was seen, and
/// where no surface of another height was seen within the hull's radius and the margin. A surface above the take-off
/// floor must have been seen across the whole hull. nullopt without such a place within reach.
std::optional<Eigen::Vector2d> landingPlace(const CostMap& map, const common::LevelMap& levels,
                                            const Eigen::Vector2d& from_map_m, const LandingNeeds& needs);

/// Where the floor at `from_map_m` was seen to one side only, as at the end of the trail: the place beyond from which
/// the beams that look down see it to the other side too, straight on or up to 60 deg aside. nullopt if it was seen to
/// both sides, if a surface of another height was seen, or if no straight line to such a place is free.
std::optional<Eigen::Vector2d> placeToLookFrom(const CostMap& map, const common::LevelMap& levels,
                                               const Eigen::Vector2d& from_map_m, const LandingNeeds& needs);

}  // namespace swiftlet::planning
