// What a standing vehicle sees, and whether that carries a flight.
#include "autonomy/estimation/start_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scan_matching/planar_world.hpp"

namespace swiftlet::autonomy {
namespace {

using common::kRadPerDeg;
using common::LaserConfig;
using common::Pose3;
using common::Time;
using testing::HasSubstr;

constexpr double kStanding_m = 0.125;

/// The small laser of a vacuum cleaner, with a mirror.
LaserConfig shortSighted() {
  LaserConfig laser;
  laser.beams = 360;
  laser.field_of_view_deg = 360;
  laser.rate_hz = 5;
  laser.sweep_s = 0.2;
  laser.range_min_m = 0.12;
  laser.range_max_m = 3.5;
  laser.mirror_first_beam = 352;
  laser.mirror_beams = 8;
  laser.mount.z_m = 0.08;
  laser.mirror_mount = {.x_m = -0.05, .y_m = 0.03, .z_m = 0.06};
  return laser;
}

LaserConfig farSighted() {
  LaserConfig laser;
  laser.mirror_first_beam = 1070;
  laser.mirror_beams = 11;
  laser.mount.z_m = 0.08;
  laser.mirror_mount = {.x_m = -0.05, .y_m = 0.03, .z_m = 0.06};
  return laser;
}

/// A room with the vehicle in its middle.
test::PlanarWorld hall(double width_m, double depth_m) {
  test::PlanarWorld world;
  world.addBox(0.0, 0.0, width_m, depth_m, 0.3);
  world.ceiling_m = 8.0;
  return world;
}

common::LaserScan scanOf(const test::PlanarWorld& world, const LaserConfig& laser, std::uint64_t seed = 1) {
  common::RandomStream random(seed, "laser", 0);
  const Pose3 standing{Eigen::Quaterniond::Identity(), {0.0, 0.0, kStanding_m}};
  return test::sweep(
      world, laser, [&](Time) { return standing; }, Time::fromSeconds(1.0), random);
}

std::string problemOf(const common::LaserScan& scan, const LaserConfig& laser, double roll_error_deg = 0.0,
                      bool position_known = false) {
  StartView view(LaserPipelineConfig{}, laser, kStanding_m);
  view.add(scan, common::quaternionFrom({roll_error_deg * kRadPerDeg, 0.0, 0.0}));
  return view.problem(scan.stamps.arrived, position_known);
}

TEST(StartView, ARoomWithinReachCarriesAFlight) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(problemOf(scanOf(hall(5.0, 4.0), shortSighted(), seed), shortSighted()), "");
    EXPECT_EQ(problemOf(scanOf(test::flat(), farSighted(), seed), farSighted()), "");
    EXPECT_EQ(problemOf(scanOf(hall(36.0, 30.0), farSighted(), seed), farSighted()), "") << "a big hall";
  }
}

TEST(StartView, FarWallsCountThoughAnAttitudeOffByADegreePutsThemOnTheFloor) {
  for (const double error_deg : {-1.0, 1.0})
    EXPECT_EQ(problemOf(scanOf(hall(36.0, 30.0), farSighted()), farSighted(), error_deg), "") << error_deg;
}

TEST(StartView, ALaserThatReachesNothingFixesNoPosition) {
  const common::LaserScan scan = scanOf(hall(16.0, 16.0), shortSighted());
  EXPECT_EQ(problemOf(scan, shortSighted()),
            "no beams of the laser return from within 3.5 m; 30 are needed to fix the position");
  EXPECT_EQ(problemOf(scan, shortSighted(), 0.0, true), "") << "a camera fixes it";
}

TEST(StartView, AFewReturnsFixNoPosition) {
  test::PlanarWorld world = hall(16.0, 16.0);
  world.addBox(1.5, 0.0, 0.2, 0.2);
  EXPECT_THAT(problemOf(scanOf(world, shortSighted()), shortSighted()), HasSubstr("30 are needed"));
}

/// A corridor is flown through though its ends are not seen.
TEST(StartView, WallsThatLeaveADirectionFreeCarryAFlight) {
  test::PlanarWorld world;
  world.addPolyline({{-50.0, 1.0}, {50.0, 1.0}}, false);
  world.addPolyline({{-50.0, -1.0}, {50.0, -1.0}}, false);
  EXPECT_EQ(problemOf(scanOf(world, shortSighted()), shortSighted()), "");
}

TEST(StartView, TheEndOfACorridorOrACornerIsEnough) {
  test::PlanarWorld corridor;
  corridor.addPolyline({{-30.0, 1.0}, {2.5, 1.0}, {2.5, -1.0}, {-30.0, -1.0}}, false);
  EXPECT_EQ(problemOf(scanOf(corridor, shortSighted()), shortSighted()), "");
  test::PlanarWorld corner;
  corner.addPolyline({{-30.0, 2.0}, {2.0, 2.0}, {2.0, -30.0}}, false);
  EXPECT_EQ(problemOf(scanOf(corner, shortSighted()), shortSighted()), "");
}

TEST(StartView, BeamsDownThatReturnNothingMeasureNoHeight) {
  const LaserConfig laser = shortSighted();
  common::LaserScan scan = scanOf(hall(5.0, 4.0), laser);
  for (int beam = 0; beam < laser.beams; ++beam)
    if (laser.isMirrorBeam(beam)) scan.ranges_m[static_cast<std::size_t>(beam)] = 0.0F;
  EXPECT_EQ(problemOf(scan, laser), "none of the 8 beams down returns, and nothing else measures the height");
  LaserConfig from_afar = laser;
  from_afar.range_min_m = 0.2;
  EXPECT_EQ(problemOf(scan, from_afar), "") << "on the ground the floor is too near for it";
  LaserConfig without = laser;
  without.mirror_beams = 0;
  EXPECT_THAT(problemOf(scan, without), HasSubstr("no beam of the laser looks down"));
}

TEST(StartView, ALaserThatHasFallenSilentIsNamed) {
  StartView view(LaserPipelineConfig{}, shortSighted(), kStanding_m);
  EXPECT_EQ(view.problem(Time::fromSeconds(3.0), false), "the laser has sent no scan");
  const common::LaserScan scan = scanOf(hall(5.0, 4.0), shortSighted());
  view.add(scan, Eigen::Quaterniond::Identity());
  EXPECT_EQ(view.problem(scan.stamps.arrived + common::Duration::fromSeconds(0.4), false), "");
  EXPECT_EQ(view.problem(scan.stamps.arrived + common::Duration::fromSeconds(2.5), false),
            "the laser has been silent for 2.5 s");
}

}  // namespace
}  // namespace swiftlet::autonomy
