// Places from which a frontier is seen, and what a place would see.
#pragma once

#include <optional>
#include <vector>

#include "planning/costs/sight.hpp"
#include "planning/exploration/exploration_config.hpp"
#include "planning/exploration/frontiers.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::planning {

/// What is expected at a place under the best heading.
struct View {
  double gain_m2 = 0.0;
  double localizability = 0.0;
  double yaw_map_rad = 0.0;
};

/// A place that sees a frontier, and the unknown cell it sees.
struct Lookout {
  common::CellIndex place;
  common::CellIndex target;
  double path_m = 0.0;  ///< In metres of open space, from the vehicle.
};

/// Casts rays over one map. One thread.
class Scout {
 public:
  Scout(const CostMap& map, const CostField& from_vehicle, const ExplorationConfig& config);

  /// The cheapest to reach in each of a few rings of distance from the frontier; empty when no place that can be
  /// reached sees any of it. The laser looks through free cells only.
  std::vector<Lookout> lookouts(const FrontierRun& frontier) const;

  /// Unknown area that would be seen from the place, up to `gain_depth_m` into the unknown, and how well the pose is
  /// fixed there. Of equal headings the one nearest to `preferred_yaw_rad`.
  View view(common::CellIndex place, double preferred_yaw_rad) const;

 private:
  void lookFrom(common::CellIndex unknown, const Directions& directions, std::vector<Lookout>& rings) const;

  const CostMap& map_;
  const CostField& field_;
  const ExplorationConfig& config_;
  Directions coarse_;
  Directions fine_;
};

}  // namespace swiftlet::planning
