// The path along which a person is followed: the cheapest chain of straight lines over places where that person walked,
// where a person can pass, and which lead where the person went. It leaves out detours that a straight line cuts short.
#pragma once

#include <span>

#include <Eigen/Core>

#include "planning/costs/cost_map.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::autonomy {

/// References are read during the call only. In the `map` frame.
struct TrailQuestion {
  const planning::CostMap& costs;  ///< Without the person.
  Eigen::Vector2d from_map_m;      ///< Where the path begins; it leaves the lethal zone as all planned paths do.
  Eigen::Vector2d person_map_m;
  std::span<const Eigen::Vector2d> trail_map_m;  ///< Of the person, the newest place last.
  double ends_at_m = 1.0;                        ///< Distance from the person at which the path ends.
  double aside_m = 0.5;  ///< A place where the person walked too near to a wall is passed at most this far beside it.
};

/// To the place nearest to the person that can be reached; one point: to stay here. A pure function; safe from any
/// thread.
planning::Path trailPath(const TrailQuestion& question);

}  // namespace swiftlet::autonomy
