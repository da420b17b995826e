// The test bench of Grzonka 2012, Fig. 4: the vehicle is fixed to one axis, commands are stepped through, and the
// inertial unit tells which angle it takes.
#pragma once

#include <vector>

#include "simulation/scenario.hpp"

namespace swiftlet::simulation {

struct BenchRow {
  double command_deg = 0.0;
  double angle_deg = 0.0;  ///< Mean of what the inertial unit measures, once the vehicle has settled.
};

/// About x (0, roll) or y (1, pitch) of the body, from minus the greatest tilt to the greatest tilt in `rows` steps, at
/// least 2. The same scenario gives the same rows.
std::vector<BenchRow> attitudeBench(const Scenario& scenario, int axis_body, int rows = 9);

}  // namespace swiftlet::simulation
