// Places from which a frontier is seen, and what is seen from a place.
#pragma once

#include <optional>
#include <vector>

#include "common/intent.hpp"
#include "planning/costs/localizability.hpp"
#include "planning/costs/sight.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/exploration/frontiers.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::planning {

/// What is expected to be seen from a place with the best heading.
struct View {
  double gain_m2 = 0.0;
  double localizability = 0.0;
  double yaw_map_rad = 0.0;
};

/// A place from which a frontier is seen, and the unknown cell that is seen.
struct Lookout {
  common::CellIndex place;
  common::CellIndex target;
  double path_m = 0.0;  ///< Cost of the path from the vehicle, in metres of open space.
};

/// Casts rays over one map. Refers to its arguments, which must outlive it. Not thread-safe.
class Scout {
 public:
  /// Depth of the unknown that a beam is expected to see.
  static constexpr double kGainDepth_m = 2.0;

  /// Places outside of `bounds` are no viewpoints; null: no bounds.
  Scout(const CostMap& map, const CostField& from_vehicle, const ExplorerConfig& config,
        const common::MapBounds* bounds);

  /// For each of a few rings of distance around the frontier, the place that is cheapest to reach. The nearest ring is
  /// first. Empty when no reachable place sees any of it. A line of sight passes through free cells only.
  std::vector<Lookout> lookouts(const FrontierRun& frontier) const;

  /// The unknown area that would be seen from the place, up to kGainDepth_m into the unknown, how well the laser
  /// fixes the pose there, and the best heading. Of nearly equal headings the one nearest to `preferred_yaw_rad` is
  /// best.
  View view(common::CellIndex place, double preferred_yaw_rad) const;

  /// See planning::hasWallsToMatch.
  bool hasWallsToMatch(common::CellIndex place) const { return planning::hasWallsToMatch(map_, place, wall_); }

 private:
  void lookFrom(common::CellIndex unknown, const Directions& directions, std::vector<Lookout>& rings) const;

  const CostMap& map_;
  const CostField& field_;
  const ExplorerConfig& config_;
  const common::MapBounds* bounds_;
  Directions coarse_;
  Directions fine_;
  Directions gain_;
  Directions wall_;
};

}  // namespace swiftlet::planning
