// Which of the known levels the beams of a scan met (Grzonka 2012, Algorithm 1, line 5). Private to altitude.
#pragma once

#include <vector>

#include "common/time.hpp"
#include "perception/altitude/ground_scan.hpp"
#include "perception/altitude/height_filter.hpp"
#include "perception/altitude/level_store.hpp"
#include "perception/altitude/multilevel_config.hpp"

namespace swiftlet::perception::altitude {

inline constexpr int kFloor = 0;

/// What is known about the place of a scan, for as long as a question takes.
struct Neighbourhood {
  const MultilevelConfig& config;
  const HeightFilter& height;
  const LevelStore& store;
  const std::vector<int>& near;  ///< The levels that may explain a beam.
  common::Time now;
};

/// The less sure the height is, the likelier is what lies within its gate something else.
bool likelierThanUnknown(const MultilevelConfig& config, int id, double residual_m, double variance_m2);

/// The likeliest of the levels nearby that could be what `averaged` beams met at this distance. `known_below`: of those
/// that were below in the last scans already.
int likeliestLevel(const Neighbourhood& known, double distance_below_m, int averaged, bool known_below);

/// The levels below that could have generated a beam; each beam takes the likeliest. A surface whose middle is on no
/// level is not on one with its edge either: over a slope, that edge would take the height along.
void matchBeams(const Neighbourhood& known, GroundScan& scan);

}  // namespace swiftlet::perception::altitude
