// Each shipped profile is flown alone in the first world. Counters show that the matcher, the SLAM method, the planner
// and the explorer that it chooses did the work.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "autonomy/loop/flight_loop.hpp"
#include "common/mailbox.hpp"
#include "evaluation/map_metrics.hpp"
#include "flight/system.hpp"
#include "tests/flight_loop/short_flight.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Pose2;
using common::Time;

struct Flown {
  bool finished = false;
  double worst_m = 0.0;  ///< Of the estimate in the map, in flight.
  evaluation::WallError walls;
  perception::LaserOdometryCounts odometry;
  perception::SlamCounts slam;
  PlanningUse planning;
  Witness witness;
};

Flown fly(const std::string& name, int seed = 11) {
  const flight::SystemConfig profile = flight::loadSystem(name).config;
  EXPECT_EQ(profile.vehicle, "cobra");
  EXPECT_EQ(profile.laser, "utm_30lx");
  const auto vehicle = makeVehicle(seed);
  Autonomy autonomy = makeAutonomy(common::makeLockstepJobs(0), profile.autonomy);
  common::LosslessQueue<common::OperatorCommand> commands;
  Flown flown;
  FlightLoop loop(*vehicle, autonomy, commands, {&flown.witness});
  while (!autonomy.finished() && loop.now() < Time::fromSeconds(45)) {
    if (!loop.step(loop.now() + common::kControlPeriod)) break;
    if (!vehicle->truth().airborne) continue;
    const Pose2 truth = planar(vehicle->trueT_map_body());
    const Pose2 estimate = planar(autonomy.state().T_map_body());
    flown.worst_m = std::max(flown.worst_m, (estimate.position_m() - truth.position_m()).norm());
  }
  flown.finished = autonomy.finished() && !vehicle->truth().crashed;
  flown.odometry = autonomy.counts().estimator.odometry;
  flown.slam = autonomy.counts().estimator.slam;
  flown.planning = autonomy.counts().planning;
  const auto walls =
      evaluation::wallError(*flown.witness.last_world->map->grid, planar(vehicle->T_world_map()), vehicle->rays(), 1.0);
  if (walls) flown.walls = *walls;
  std::printf("  %-22s worst %.3f m; walls median %.3f m, p95 %.3f m; %d key scans, %d viewpoints, %d paths\n",
              name.c_str(), flown.worst_m, flown.walls.median_m, flown.walls.p95_m,
              static_cast<int>(flown.slam.key_scans), flown.planning.viewpoints, flown.planning.paths);
  return flown;
}

void expectGood(const Flown& flown) {
  EXPECT_TRUE(flown.finished);
  EXPECT_LT(flown.worst_m, 0.05);
  EXPECT_GT(flown.walls.cells, 500U);
  EXPECT_LT(flown.walls.median_m, 0.03);
  EXPECT_LT(flown.walls.p95_m, 0.05);
}

/// The chosen matcher searched for the scans of the flight, and no other matcher did.
void expectMatchers(const Flown& flown, bool correlative, bool gauss_newton, bool point_to_line) {
  EXPECT_EQ(flown.odometry.correlative_searches > 300, correlative);
  EXPECT_EQ(flown.odometry.gauss_newton_searches > 300, gauss_newton);
  EXPECT_EQ(flown.odometry.point_to_line_searches > 300, point_to_line);
  EXPECT_EQ((flown.odometry.correlative_searches > 0) + (flown.odometry.gauss_newton_searches > 0) +
                (flown.odometry.point_to_line_searches > 0),
            1);
}

void expectMethods(const Flown& flown, bool graph, bool particles, bool scan_to_map) {
  const perception::SlamCounts& counts = flown.slam;
  EXPECT_GT(counts.scans, 300U);
  EXPECT_EQ(counts.graph_matches > 10, graph);
  EXPECT_EQ(counts.particle_matches > 10, particles);
  EXPECT_EQ(counts.map_matches > 10, scan_to_map);
  EXPECT_EQ((counts.graph_matches > 0) + (counts.particle_matches > 0) + (counts.map_matches > 0), 1);
}

/// The counters are those of the planner and the explorer of these names, and each had results that were flown.
void expectPlanning(const Flown& flown, const std::string& planner, const std::string& explorer) {
  EXPECT_EQ(flown.planning.planner, planner);
  EXPECT_EQ(flown.planning.explorer, explorer);
  EXPECT_GE(flown.planning.viewpoints, 2);
  EXPECT_GE(flown.planning.paths, flown.planning.viewpoints);
}

TEST(ShippedProfile, SwiftletFliesWithGraphSlam) {
  const Flown flown = fly("swiftlet");
  expectGood(flown);
  expectMatchers(flown, true, false, false);
  expectMethods(flown, true, false, false);
  expectPlanning(flown, "D* Lite", "utility");
}

TEST(ShippedProfile, TheWavefrontPlannerFlies) {
  const Flown flown = fly("swiftlet_wavefront");
  expectGood(flown);
  expectPlanning(flown, "wavefront", "utility");
}

TEST(ShippedProfile, TheNearestFrontierExplorerFlies) {
  const Flown flown = fly("swiftlet_nearest_frontier");
  expectGood(flown);
  expectPlanning(flown, "D* Lite", "nearest frontier");
}

TEST(ShippedProfile, ParticlesFlyRepeatably) {
  const Flown flown = fly("swiftlet_particles");
  expectGood(flown);
  expectMatchers(flown, true, false, false);
  expectMethods(flown, false, true, false);
  EXPECT_EQ(flown.slam.particle_matches % 30, 0U) << "every scan that is taken in is matched by all particles";
  EXPECT_EQ(difference(flown.witness, fly("swiftlet_particles").witness), "");
}

TEST(ShippedProfile, ScanToMapFliesRepeatably) {
  const Flown flown = fly("swiftlet_scan_to_map");
  expectGood(flown);
  expectMatchers(flown, true, false, false);
  expectMethods(flown, false, false, true);
  EXPECT_LT(flown.slam.local_failures, flown.slam.map_matches / 10);
  EXPECT_EQ(difference(flown.witness, fly("swiftlet_scan_to_map").witness), "");
}

TEST(ShippedProfile, TheGaussNewtonMatcherFlies) {
  const Flown flown = fly("swiftlet_gauss_newton");
  expectGood(flown);
  expectMatchers(flown, false, true, false);
  expectMethods(flown, true, false, false);
}

TEST(ShippedProfile, ThePointToLineMatcherFlies) {
  const Flown flown = fly("swiftlet_point_to_line");
  expectGood(flown);
  expectMatchers(flown, false, false, true);
  expectMethods(flown, true, false, false);
}

}  // namespace
}  // namespace swiftlet::autonomy
