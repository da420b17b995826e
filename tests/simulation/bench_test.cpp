// The bench gives the curve from command to angle that the autopilot has, and repeats.
#include <gtest/gtest.h>

#include "simulation/bench.hpp"

namespace swiftlet::simulation {
namespace {

TEST(Bench, ShowsTheAngleThatTheAutopilotTakes) {
  Scenario scenario;
  scenario.seed = 4;
  for (const int axis : {0, 1}) {
    for (const BenchRow& row : attitudeBench(scenario, axis, 5)) EXPECT_NEAR(row.angle_deg, row.command_deg, 0.4);
  }
  scenario.autopilot.tilt_share = 0.8;
  scenario.autopilot.tilt_expo = 0.3;
  const auto bent = attitudeBench(scenario, 1, 5);
  const double half = 0.5, most_deg = scenario.vehicle.max_tilt_deg;
  EXPECT_NEAR(bent[4].angle_deg, 0.8 * most_deg, 0.4);
  EXPECT_NEAR(bent[3].angle_deg, 0.8 * most_deg * (0.7 * half + 0.3 * half * half * half), 0.4);
  EXPECT_NEAR(bent[2].angle_deg, 0.0, 0.4);
  EXPECT_EQ(attitudeBench(scenario, 1, 5)[1].angle_deg, bent[1].angle_deg);
}

}  // namespace
}  // namespace swiftlet::simulation
