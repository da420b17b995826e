// Maps of tests, drawn beam by beam.
#pragma once

#include <algorithm>

#include "common/occupancy_grid.hpp"

namespace swiftlet::test_support {

/// The cell after one more observation of `steps` log-odds steps (positive: hit), capped.
inline common::occupancy::Cell observed(common::occupancy::Cell cell, int steps) {
  constexpr int kMost = common::occupancy::kMaxSteps;
  return static_cast<common::occupancy::Cell>(
      std::clamp((common::occupancy::isUnknown(cell) ? 0 : cell) + steps, -kMost, kMost));
}

}  // namespace swiftlet::test_support
