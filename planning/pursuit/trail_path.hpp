// The path along which a person is followed: the cheapest chain of straight lines over places where that person walked,
// where a person can pass, and which lead where the person went. It leaves out detours that a straight line cuts short.
#pragma once

#include <span>

#include <Eigen/Core>

#include "planning/costs/cost_map.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::planning {

/// Distance from the person at which the path ends. It is farther ahead than the vehicle needs to brake, so that it
/// does not end at rest while the person walks (docs/decisions/following.md#067).
inline constexpr double kTrailEndsAt_m = 1.0;

/// From a place to the one nearest to the person that can be reached; one point: to stay there. It leaves the lethal
/// zone as all planned paths do. `costs` is without the person; `trail_map_m` is of the person, the newest place last.
/// A pure function; safe from any thread. In the `map` frame.
Path trailPath(const CostMap& costs, const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& person_map_m,
               std::span<const Eigen::Vector2d> trail_map_m);

}  // namespace swiftlet::planning
