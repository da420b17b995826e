// Paths of the hull in space, through windows and gaps and over tables: RRT-Connect (Kuffner and LaValle 2000) and
// shortcuts of the Open Motion Planning Library, in the clearance of the hull. Where samples find nothing, the
// reachable space answers: by a path along its cells, or that there is none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "planning/clearance/clearance.hpp"

namespace swiftlet::planning {

/// A polyline for the middle of the hull in the `map` frame, from exactly the start to exactly the goal.
struct SpacePath {
  std::vector<Eigen::Vector3d> points_map_m;  ///< At least two.
  double length_m = 0.0;
  double clearance_m = 0.0;  ///< The least along it, up to the reach of the clearance.
  std::size_t states = 0;    ///< Of the trees, or cells that were reached.
};

/// Why there is no path.
struct SpacePlanFailure {
  enum class Reason { kOutsideMap, kStartBlocked, kGoalBlocked, kUnreachable };
  Reason reason = Reason::kUnreachable;
  std::string text;  ///< For people, with values.
  /// The place nearest to a blocked start or goal where the hull may be, within 3 m, or the reachable one nearest to
  /// the goal.
  std::optional<Eigen::Vector3d> nearest_map_m;
};

struct SamplingEffort {
  int iterations = 20000;  ///< Of RRT-Connect, before the reachable space is asked.
  bool simplify = true;    ///< Otherwise the path is the first that was found.
};

/// The path depends on the arguments only: it ends by iterations and draws from streams of its own, so that it is the
/// same whatever other threads plan. `radius_m` is that of the hull and what it keeps clear; in the plane the path
/// stays at the height of the start.
[[nodiscard]] tl::expected<SpacePath, SpacePlanFailure> planBySampling(const Clearance& clearance,
                                                                       const Eigen::Vector3d& start_map_m,
                                                                       const Eigen::Vector3d& goal_map_m,
                                                                       double radius_m, std::uint64_t seed = 0,
                                                                       const SamplingEffort& effort = {});

}  // namespace swiftlet::planning
