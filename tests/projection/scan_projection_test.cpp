#include "perception/projection/scan_projection.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/scan_matching/planar_world.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose3;
using common::Time;

common::LaserConfig noiseless() {
  common::LaserConfig laser;
  laser.range_noise_m = 0.0;
  laser.dropout_rate = 0.0;
  return laser;
}

/// Turns, flies and sways at once.
Pose3 restless(Time time) {
  const double t = time.seconds();
  return {common::quaternionFrom({0.05 * std::sin(9.0 * t), 0.08 * std::cos(7.0 * t), 0.3 + 2.0 * t}),
          {0.4 + 1.0 * t, -0.2 + 0.7 * t, 1.0 + 0.2 * t}};
}

common::LaserScan scanOf(const std::vector<float>& ranges, const common::LaserConfig& laser) {
  common::LaserScan scan;
  scan.angle_min_rad = laser.angleMin_rad();
  scan.angle_increment_rad = laser.angleIncrement_rad();
  scan.range_min_m = laser.range_min_m;
  scan.range_max_m = laser.range_max_m;
  scan.ranges_m = ranges;
  return scan;
}

const PoseAt kStill = [](Time) { return Pose3{Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.0}}; };

TEST(ScanProjection, EqualsTheProjectionBeamByBeam) {
  common::LaserConfig laser = noiseless();
  laser.mount.x_m = 0.1;
  laser.mount.z_m = 0.05;
  laser.mount.pitch_deg = 2.0;
  common::RandomStream random(1, "projection");
  const test::PlanarWorld world = test::flat();
  const common::LaserScan scan = test::sweep(world, laser, restless, Time::fromSeconds(0.37), random);
  const ProjectedScan projected = project(scan, laser, restless, {});

  const Pose3 reference = restless(projected.stamp);
  const Pose3 T_level_odom =
      Pose3{common::quaternionFrom({0, 0, common::yawOf(reference.rotation)}), reference.position_m}.inverse();
  std::size_t next = 0;
  for (int beam = 0; beam < laser.beams && next < projected.points_level_m.size(); ++beam) {
    const Eigen::Vector3d expected =
        T_level_odom * restless(scan.stamps.measured + scan.time_increment * beam) * laser.mount.pose() *
        Eigen::Vector3d(scan.ranges_m[static_cast<std::size_t>(beam)] * laser.direction(beam));
    const Eigen::Vector2f& found = projected.points_level_m[next];
    if ((found.cast<double>() - expected.head<2>()).norm() > 2e-3) continue;  // This beam was left out.
    EXPECT_NEAR(projected.heights_level_m[next], expected.z(), 2e-3);
    ++next;
  }
  EXPECT_EQ(next, projected.points_level_m.size());
  EXPECT_GT(next, 1000U);
}

TEST(ScanProjection, CorrectsWallsForMotionAndTilt) {
  const common::LaserConfig laser = noiseless();
  common::RandomStream random(1, "projection");
  const test::PlanarWorld world = test::flat();
  const auto start = Time::fromSeconds(0.2);
  const common::LaserScan scan = test::sweep(world, laser, restless, start, random);
  const ProjectedScan projected = project(scan, laser, restless, {});
  const common::Pose2 T_world_level = common::planar(restless(projected.stamp));
  double worst_m = 0.0;
  for (const Eigen::Vector2f& p : projected.points_level_m)
    worst_m = std::max(worst_m, world.distanceToWall(T_world_level * p.cast<double>()));
  EXPECT_LT(worst_m, 2e-3);

  // The test can fail: without the motion the same walls are centimetres off.
  Pose3 frozen = restless(projected.stamp);
  double smeared_m = 0.0;
  for (const Eigen::Vector2f& p : project(scan, laser, [&](Time) { return frozen; }, {}).points_level_m)
    smeared_m = std::max(smeared_m, world.distanceToWall(T_world_level * p.cast<double>()));
  EXPECT_GT(smeared_m, 0.02);
}

/// A large room seen from a height of 1 m with the nose 15 degrees down.
struct TiltedView : testing::Test {
  TiltedView() { world.addBox(0.0, 0.0, 30.0, 30.0); }
  ProjectedScan view(const ScanProjectionConfig& config) const {
    common::RandomStream random(1, "projection");
    const PoseAt tilted = [](Time) {
      return Pose3{common::quaternionFrom({0.0, 15.0 * kRadPerDeg, 0.0}), {0.0, 0.0, 1.0}};
    };
    return project(test::sweep(world, noiseless(), tilted, Time{}, random), noiseless(), tilted, config);
  }
  void expectOnlyWalls(const ProjectedScan& projected) const {
    for (const Eigen::Vector2f& point : projected.points_level_m)
      EXPECT_LT(world.distanceToWall(point.cast<double>()), 1e-3);
  }
  test::PlanarWorld world;
};

TEST_F(TiltedView, LeavesOutFloorAndCeiling) {
  ScanProjectionConfig config;
  config.ceiling_height_odom_m = world.ceiling_m;
  const ProjectedScan projected = view(config);
  EXPECT_GT(projected.counts.floor_hits, 300);
  EXPECT_GT(projected.counts.ceiling_hits, 100);
  expectOnlyWalls(projected);
  // The cells that they crossed near the height of the body are still free.
  EXPECT_EQ(projected.misses_level_m.size(),
            static_cast<std::size_t>(projected.counts.floor_hits + projected.counts.ceiling_hits));
  for (const Eigen::Vector3f& end : projected.misses_level_m) {
    EXPECT_GT(end.norm(), 1.0);
    EXPECT_LE(std::abs(end.x()) * std::tan(15.0 * kRadPerDeg), config.free_band_m + 1e-3);
  }
}

TEST_F(TiltedView, UnderAnUnknownCeilingLeavesOutWhatRisesFar) {
  const ProjectedScan projected = view({});
  EXPECT_GT(projected.counts.ceiling_hits, 100);
  expectOnlyWalls(projected);
}

TEST(ScanProjection, KeepsALevelBeamNearTheFloorAsAWall) {
  const common::LaserConfig laser = noiseless();
  test::PlanarWorld world;
  world.addBox(0.0, 0.0, 30.0, 30.0);
  Pose3 standing{Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.08}};
  common::RandomStream random(1, "projection");
  const auto scan = test::sweep(
      world, laser, [&](Time) { return standing; }, Time{}, random);
  EXPECT_EQ(project(scan, laser, [&](Time) { return standing; }, {}).counts.hits, laser.beams);
}

TEST(ScanProjection, CountsUnusableBeams) {
  common::LaserConfig laser = noiseless();
  laser.beams = 12;
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const ProjectedScan projected = project(
      scanOf({1.0F, nan, -1.0F, 0.05F, -inf, inf, 2.0F, inf, inf, 40.0F, 0.0F, 3.0F}, laser), laser, kStill, {});
  EXPECT_EQ(projected.counts, (BeamCounts{3, 4, 5, 0, 0, 0, 0}));
  EXPECT_EQ(projected.points_level_m.size(), 3U);
  // The lone beam without return is a dropout; the three side by side are free space up to the greatest range.
  EXPECT_TRUE(projected.misses_level_m.empty());
  ASSERT_EQ(projected.no_returns_level_m.size(), 3U);
  EXPECT_NEAR(projected.no_returns_level_m[0].head<2>().norm(), laser.range_max_m, 1e-3);
}

/// Twenty beams on a near surface, `between`, and twenty on a far one.
int hitsOf(const std::vector<float>& between) {
  std::vector<float> ranges(20, 2.0F);
  ranges.insert(ranges.end(), between.begin(), between.end());
  ranges.insert(ranges.end(), 20, 4.0F);
  return project(scanOf(ranges, noiseless()), noiseless(), kStill, {}).counts.hits - 40;
}

TEST(ScanProjection, AMixedPixelBetweenTwoSurfacesIsNone) {
  EXPECT_EQ(hitsOf({3.1F}), 0);
  EXPECT_EQ(hitsOf({2.3F}), 0);
  EXPECT_EQ(hitsOf({2.03F}), 1) << "noise of the near one";
  EXPECT_EQ(hitsOf({1.2F}), 1) << "a thin thing before both";
  EXPECT_EQ(hitsOf({5.0F}), 1) << "a gap in both";
  EXPECT_EQ(hitsOf({3.0F, 3.01F, 3.02F}), 3) << "a surface between them";
  EXPECT_EQ(hitsOf({std::numeric_limits<float>::infinity(), 3.0F, NAN}), 1);
  std::vector<float> slanted;
  for (int i = 0; i < 40; ++i) slanted.push_back(2.0F * std::pow(1.1F, static_cast<float>(i)));
  const auto counts = project(scanOf(slanted, noiseless()), noiseless(), kStill, {}).counts;
  EXPECT_EQ(counts.hits + counts.no_returns, 40) << "a wall that is seen at a glancing angle";
}

TEST(ScanProjection, ToleratesInvalidInput) {
  const common::LaserConfig laser = noiseless();
  EXPECT_TRUE(project({}, laser, kStill, {}).points_level_m.empty());
  common::LaserScan scan = scanOf(std::vector<float>(1081, 2.0F), laser);
  const PoseAt lost = [](Time) {
    return Pose3{Eigen::Quaterniond::Identity(), Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())};
  };
  EXPECT_EQ(project(scan, laser, lost, {}).counts.invalid, 1081);
  scan.angle_min_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(project(scan, laser, kStill, {}).counts.invalid, 1081);
}

TEST(ScanProjection, MirrorBeamsBecomeHeights) {
  common::LaserConfig laser = noiseless();
  laser.mirror_first_beam = 100;
  laser.mirror_beams = 21;
  laser.mirror_mount.x_m = 0.12;
  laser.mirror_mount.z_m = -0.03;
  Pose3 tilted{common::quaternionFrom({0.1, -0.05, 0.7}), {0.5, 0.3, 1.2}};
  common::RandomStream random(1, "projection");
  common::LaserScan scan = test::sweep(
      test::flat(), laser, [&](Time) { return tilted; }, Time{}, random);
  scan.ranges_m[105] = std::numeric_limits<float>::quiet_NaN();
  const ProjectedScan projected = project(scan, laser, [&](Time) { return tilted; }, {});
  EXPECT_EQ(projected.counts.mirror, 20);
  EXPECT_EQ(projected.counts.mirror_invalid, 1);
  for (const MirrorPoint& p : projected.mirror) EXPECT_NEAR(p.belowBody_m(), 1.2, 1e-4);
  // A scan with another number of beams has no known mirror.
  scan.ranges_m.pop_back();
  EXPECT_TRUE(project(scan, laser, [&](Time) { return tilted; }, {}).mirror.empty());
}

}  // namespace
}  // namespace swiftlet::perception
