// Steps of the surface below a path, and what they cost (Grzonka 2012, section IV-E).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "common/level_map.hpp"
#include "planning/clearance/cell_states.hpp"

namespace swiftlet::planning {

struct SurfaceSteps {
  /// No step is higher, so that the cost of an edge is bounded: levels are taken as within 2.5 m of the take-off floor.
  static constexpr int kGreatest_cm = 500;

  std::vector<std::int16_t> heights_cm;  ///< Of the surface below each cell; empty if there are no levels.
  std::int32_t cost_per_cm = 0;          ///< Added to the cost of an edge for each cm of step.

  /// What the step between two cells adds to the cost of their edge.
  std::int32_t cost(int from, int to) const {
    if (heights_cm.empty()) return 0;
    return cost_per_cm *
           std::abs(heights_cm[static_cast<std::size_t>(from)] - heights_cm[static_cast<std::size_t>(to)]);
  }
  std::int32_t greatestCost() const { return heights_cm.empty() ? 0 : cost_per_cm * kGreatest_cm; }
};

/// The highest level in each cell, and the take-off floor where there is none. `levels` may be null.
SurfaceSteps surfaceSteps(const CellStates& cells, const common::LevelMap* levels, std::int32_t cost_per_cm);

}  // namespace swiftlet::planning
