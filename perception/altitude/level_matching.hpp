// Assigns the beams of a scan to known levels (Grzonka 2012, Algorithm 1, line 5). Private to altitude.
#pragma once

#include <vector>

#include "common/time.hpp"
#include "perception/altitude/ground_scan.hpp"
#include "perception/altitude/height_filter.hpp"
#include "perception/altitude/level_store.hpp"
#include "perception/altitude/multilevel_config.hpp"

namespace swiftlet::perception::altitude {

inline constexpr int kFloor = 0;

/// References to what is known at the place of a scan. Valid only during one call.
struct Neighbourhood {
  const MultilevelConfig& config;
  const HeightFilter& height;
  const LevelStore& store;
  const std::vector<int>& near;  ///< The levels that may explain a beam.
  common::Time now;
};

/// Whether a level explains a residual better than an unknown surface would. The more uncertain the height, the
/// likelier an unknown surface within its gate.
bool likelierThanUnknown(int id, double residual_m, double variance_m2);

/// The likeliest of the nearby levels that could have been hit by `averaged` beams at this mean distance; kNoLevel if
/// there is none. With `known_below`, only levels that were below the vehicle in the last scans.
int likeliestLevel(const Neighbourhood& known, double distance_below_m, int averaged, bool known_below);

/// Assigns each beam to the likeliest level below the vehicle. If the middle of a surface is on no level, none of its
/// beams is assigned: over a slope, its edge would otherwise pull the height.
void matchBeams(const Neighbourhood& known, GroundScan& scan);

}  // namespace swiftlet::perception::altitude
