// The maps of ParticleSlam, which share their tiles, and the match of a scan to one of them.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "perception/slam2d/particle/map_match.hpp"
#include "perception/slam2d/surface_map.hpp"
#include "tests/scan_matching/planar_world.hpp"

namespace swiftlet::perception {
namespace {

using common::CellIndex;
using common::kRadPerDeg;
using common::Pose2;
using common::RandomStream;

// --- Maps. ---

/// A scan of the world from a pose, by a level laser.
ProjectedScan scanOf(const test::PlanarWorld& world, const Pose2& T_world_body, std::uint64_t seed,
                     double range_max_m = 20.0) {
  common::LaserConfig laser;
  laser.mirror_beams = 0;
  laser.beams = 361;
  laser.field_of_view_deg = 180.0;
  laser.range_max_m = range_max_m;
  laser.sweep_s = 0.0;
  RandomStream random(seed, "scan");
  const auto pose = [&](common::Time) { return common::lifted(T_world_body, 1.0); };
  return project(test::sweep(world, laser, pose, {}, random), laser, pose, {});
}

SurfaceMap mapOf(const test::PlanarWorld& world, const std::vector<Pose2>& poses, const GridDrawingConfig& config,
                 double range_max_m = 20.0) {
  SurfaceMap map(config);
  DrawingBoard board;
  std::uint64_t seed = 100;
  for (const Pose2& pose : poses) map.draw(toDraw(scanOf(world, pose, ++seed, range_max_m), config), pose, board);
  return map;
}

SurfaceScan wallAhead(double distance_m) {
  SurfaceScan scan;
  for (double y = -1.0; y <= 1.0; y += 0.02)
    scan.hits.push_back({Eigen::Vector2d(distance_m, y).cast<float>(), {-1.0F, 0.0F}});
  return scan;
}

TEST(SurfaceMap, ConfidenceIsCapped) {
  const GridDrawingConfig config;
  SurfaceMap map(config);
  DrawingBoard board;
  const CellIndex wall = map.cellAt({2.02, 0.0}), before = map.cellAt({1.0, 0.0});
  for (int i = 0; i < 1000; ++i) map.draw(wallAhead(2.02), {}, board);
  EXPECT_EQ(map.at(wall).log_odds, config.max_steps);
  EXPECT_EQ(map.at(before).log_odds, -config.max_steps);
  EXPECT_LE(map.at(wall).hits, SurfaceMap::kMaxHits);
}

TEST(SurfaceMap, BeamsWithoutReturnDoNotClearBehindADarkWall) {
  const GridDrawingConfig config;
  SurfaceMap map(config);
  DrawingBoard board;
  const CellIndex wall = map.cellAt({2.02, 0.0}), before = map.cellAt({1.0, 0.0}), behind = map.cellAt({3.0, 0.0});
  for (int i = 0; i < 3; ++i) map.draw(wallAhead(2.02), {}, board);
  const auto sure = map.at(wall).log_odds;
  SurfaceScan dark;
  dark.no_returns_m = {{9.0F, 0.0F}, {9.0F, 0.05F}, {9.0F, -0.05F}};
  for (int i = 0; i < 50; ++i) map.draw(dark, {}, board);
  EXPECT_EQ(map.at(wall).log_odds, sure);
  EXPECT_TRUE(common::occupancy::isUnknown(map.at(behind).log_odds));
  EXPECT_EQ(map.at(before).log_odds, -config.max_steps) << "up to the wall they do clear";
  SurfaceMap open(config);
  open.draw(dark, {}, board);
  EXPECT_TRUE(common::occupancy::isFree(open.at(behind).log_odds));
}

/// However long it stood there: a thousand scans of a wall are forgotten as fast as ten.
TEST(SurfaceMap, AChangedPlaceIsSoonRemapped) {
  const GridDrawingConfig config;
  DrawingBoard board;
  std::vector<int> scans_to_free, scans_to_occupied;
  for (const int seen : {10, 1000}) {
    SurfaceMap map(config);
    const CellIndex wall = map.cellAt({2.02, 0.0});
    for (int i = 0; i < seen; ++i) map.draw(wallAhead(2.02), {}, board);
    int scans = 0;
    for (; map.at(wall).isOccupied(); ++scans) map.draw(wallAhead(4.02), {}, board);
    scans_to_free.push_back(scans);
    for (int i = 0; i < seen; ++i) map.draw(wallAhead(4.02), {}, board);
    for (scans = 0; !map.at(wall).isOccupied(); ++scans) map.draw(wallAhead(2.02), {}, board);
    scans_to_occupied.push_back(scans);
  }
  EXPECT_EQ(scans_to_free[0], scans_to_free[1]);
  EXPECT_LE(scans_to_free[1], 12);
  EXPECT_EQ(scans_to_occupied[0], scans_to_occupied[1]);
  EXPECT_LE(scans_to_occupied[1], 4);
}

TEST(SurfaceMap, SurfacesAreMoreAccurateThanTheCellSize) {
  DrawingBoard board;
  for (const double distance_m : {2.012, 2.021, 2.034}) {
    SurfaceMap fresh{GridDrawingConfig{}};
    for (int i = 0; i < 5; ++i) fresh.draw(wallAhead(distance_m), {}, board);
    const CellIndex index = fresh.cellAt({distance_m, 0.0});
    EXPECT_NEAR(fresh.surface_m(index, fresh.at(index)).x(), distance_m, 0.001);
    EXPECT_LT(fresh.at(index).normal_x, -120);
  }
}

std::vector<int> bytesOf(const SurfaceMap& map) {
  std::vector<int> bytes;
  map.grid().forEachCell([&](CellIndex c, const SurfaceCell& cell) {
    if (cell != map.grid().background())
      bytes.insert(bytes.end(),
                   {c.x, c.y, cell.log_odds, cell.hits, cell.offset_x, cell.offset_y, cell.normal_x, cell.normal_y});
  });
  return bytes;
}

TEST(SurfaceMap, DrawingDoesNotAffectOtherCopies) {
  DrawingBoard board;
  SurfaceMap parent{GridDrawingConfig{}};
  parent.draw(wallAhead(2.0), {}, board);
  const auto before = bytesOf(parent);
  SurfaceMap child = parent.snapshot(), sibling = parent.snapshot(), grandchild = child.snapshot();
  child.draw(wallAhead(1.0), {0.0, 0.0, 0.3}, board);
  EXPECT_NE(bytesOf(child), before);
  EXPECT_EQ(bytesOf(parent), before);
  EXPECT_EQ(bytesOf(sibling), before);
  EXPECT_EQ(bytesOf(grandchild), before);
  parent.draw(wallAhead(3.0), {}, board);
  EXPECT_EQ(bytesOf(sibling), before);
  EXPECT_EQ(bytesOf(grandchild), before);
}

TEST(SurfaceMap, TilesWithoutDrawingStayShared) {
  DrawingBoard board;
  SurfaceMap parent{GridDrawingConfig{}};
  parent.draw(wallAhead(2.0), {}, board);
  parent.draw(wallAhead(2.0), {40.0, 0.0, 0.0}, board);
  SurfaceMap child = parent.snapshot();
  const CellIndex here = parent.cellAt({1.0, 0.0}), there = parent.cellAt({41.0, 0.0});
  child.draw(wallAhead(2.0), {}, board);
  EXPECT_NE(child.grid().tileIdentity(here), parent.grid().tileIdentity(here));
  EXPECT_EQ(child.grid().tileIdentity(there), parent.grid().tileIdentity(there));
}

/// Three beams ahead, level, up and down, from a body at a height over the floor.
ProjectedScan nodding(double body_m) {
  ProjectedScan scan;
  scan.T_odom_body.position_m.z() = body_m;
  scan.points_level_m = {{2.0F, 0.0F}, {4.0F, 1.0F}, {4.0F, -1.0F}};
  scan.heights_level_m = {0.1F, 0.5F, -0.5F};
  return scan;
}

TEST(SurfaceMap, DrawsOnlyTheHeightBand) {
  const GridDrawingConfig config;
  const DrawnHeights heights = heightsAround(1.0, config);  // 0.75 to 1.25 m.
  const SurfaceScan level = toDraw(nodding(1.0), config, heights);
  ASSERT_EQ(level.hits.size(), 1U);
  EXPECT_EQ(level.hits[0].point_m.x(), 2.0F);
  // The other two beams leave the band halfway; up to there the space is free.
  ASSERT_EQ(level.free_m.size(), 2U);
  for (const Eigen::Vector2f& end : level.free_m) EXPECT_NEAR(end.x(), 2.0F, 1e-5F);
  // The band is that of the flight, not of the body.
  const SurfaceScan lower = toDraw(nodding(0.8), config, heights);
  ASSERT_EQ(lower.hits.size(), 1U);
  ASSERT_EQ(lower.free_m.size(), 2U);
  EXPECT_NEAR(lower.free_m[0].x(), 4.0F * 0.9F, 1e-5F);
  EXPECT_NEAR(lower.free_m[1].x(), 4.0F * 0.1F, 1e-5F);
  const SurfaceScan from_the_floor = toDraw(nodding(0.2), config, heights);
  EXPECT_TRUE(from_the_floor.hits.empty() && from_the_floor.free_m.empty());
}

TEST(SurfaceMap, TheContourLiesOnTheSurfaces) {
  DrawingBoard board;
  SurfaceMap map{GridDrawingConfig{}};
  for (int i = 0; i < 5; ++i) map.draw(wallAhead(2.034), {}, board);
  const std::vector<ContourSegment> contour = map.contourAround({2.0, 0.0}, 5.0);
  EXPECT_GE(contour.size(), 40U);
  double length_m = 0.0;
  for (const ContourSegment& piece : contour) {
    EXPECT_NEAR(piece.begin_m.x(), 2.034, 0.002);
    EXPECT_NEAR(piece.end_m.x(), 2.034, 0.002);
    length_m += (piece.end_m - piece.begin_m).norm();
  }
  EXPECT_NEAR(length_m, 2.05, 0.1);
  EXPECT_TRUE(map.contourAround({20.0, 0.0}, 5.0).empty());
}

// --- Matching. ---

Eigen::Matrix3d motionCovariance(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

TEST(MapMatch, FindsThePoseWithAMatchingCovariance) {
  const test::PlanarWorld world = test::flat();
  const GridDrawingConfig map_config;
  const SurfaceMap map = mapOf(world, {{0.0, 0.0, 0.0}, {0.3, 0.1, 0.2}, {0.5, 0.3, -0.2}}, map_config);
  double nees = 0.0, worst_m = 0.0, worst_rad = 0.0;
  constexpr int kCases = 60;
  for (std::uint64_t seed = 0; seed < kCases; ++seed) {
    RandomStream random(seed, "pose");
    const Pose2 truth{random.uniform(-0.2, 0.6), random.uniform(-0.2, 0.4), random.uniform(-0.3, 0.3)};
    const auto points = pointsToMatch(scanOf(world, truth, seed));
    const UncertainPose prior{
        {truth.x_m + random.gaussian(0.03), truth.y_m + random.gaussian(0.03), truth.yaw_rad + random.gaussian(0.01)},
        motionCovariance(0.03, 0.01)};
    const MapMatch match = matchToMap(map, points, prior);
    const Eigen::Vector3d e(match.T_map_body.x_m - truth.x_m, match.T_map_body.y_m - truth.y_m,
                            common::wrapAngle(match.T_map_body.yaw_rad - truth.yaw_rad));
    worst_m = std::max(worst_m, e.head<2>().norm());
    worst_rad = std::max(worst_rad, std::abs(e.z()));
    nees += e.dot(match.covariance.ldlt().solve(e)) / kCases;
  }
  std::printf("  at most %.1f mm, %.2f deg; nees %.2f\n", 1e3 * worst_m, worst_rad / kRadPerDeg, nees);
  EXPECT_LT(worst_m, 0.02);
  EXPECT_LT(worst_rad, 0.3 * kRadPerDeg);
  // The mean is 3 if the covariance is exact. Here it is cautious, because a real map is worse than the noise of its
  // beams.
  EXPECT_GT(nees, 0.1);
  EXPECT_LT(nees, 3.0);
}

/// A slip is not in the covariance of the motion, so only the map can correct it.
TEST(MapMatch, CorrectsASlipOfTheMotion) {
  const test::PlanarWorld world = test::flat();
  const GridDrawingConfig map_config;
  const SurfaceMap map = mapOf(world, {{0.0, 0.0, 0.0}, {0.3, 0.1, 0.2}, {0.5, 0.3, -0.2}}, map_config);
  const Pose2 truth{0.2, 0.1, 0.05};
  const auto points = pointsToMatch(scanOf(world, truth, 7));
  const UncertainPose slipped{{0.35, 0.0, 0.08}, motionCovariance(0.005, 0.002)};
  const UncertainPose right{truth, motionCovariance(0.005, 0.002)};
  const MapMatch match = matchToMap(map, points, slipped);
  EXPECT_LT((match.T_map_body.position_m() - truth.position_m()).norm(), 0.01);
  // A particle that got there without a slip is more likely.
  EXPECT_GT(matchToMap(map, points, right).log_motion, match.log_motion + 1.0);
}

TEST(MapMatch, TheRightMapIsMoreLikelyThanAWrongOne) {
  const test::PlanarWorld world = test::flat();
  test::PlanarWorld other = world;
  other.addBox(2.2, -1.5, 0.5, 0.5);
  other.addBox(1.5, 1.8, 0.6, 0.3);
  const GridDrawingConfig map_config;
  const std::vector<Pose2> poses{{0.0, 0.0, 0.0}, {0.3, 0.1, 0.1}};
  const SurfaceMap right = mapOf(world, poses, map_config), wrong = mapOf(other, poses, map_config);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Pose2 truth{0.2, 0.05, 0.05};
    const auto points = pointsToMatch(scanOf(world, truth, seed));
    const UncertainPose prior{truth, motionCovariance(0.01, 0.005)};
    EXPECT_GT(matchToMap(right, points, prior).log_likelihood, matchToMap(wrong, points, prior).log_likelihood) << seed;
  }
}

/// The map does not constrain the pose along a corridor, so the motion and its whole uncertainty remain there.
TEST(MapMatch, KeepsTheMotionAlongACorridor) {
  test::PlanarWorld corridor;
  corridor.addPolyline({{-50.0, -1.0}, {50.0, -1.0}}, false);
  corridor.addPolyline({{-50.0, 1.0}, {50.0, 1.0}}, false);
  const GridDrawingConfig map_config;
  std::vector<Pose2> poses;
  for (int i = 0; i < 10; ++i) poses.push_back({0.3 * i, 0.0, 0.0});
  const SurfaceMap map = mapOf(corridor, poses, map_config, 5.6);
  const Pose2 truth{2.5, 0.02, 0.01};
  const auto points = pointsToMatch(scanOf(corridor, truth, 3, 5.6));
  const UncertainPose prior{{2.35, 0.0, 0.0}, motionCovariance(0.1, 0.02)};
  const MapMatch match = matchToMap(map, points, prior);
  EXPECT_NEAR(match.T_map_body.x_m, prior.T_map_body.x_m, 0.02);
  EXPECT_NEAR(match.T_map_body.y_m, truth.y_m, 0.01);
  EXPECT_NEAR(match.T_map_body.yaw_rad, truth.yaw_rad, 0.005);
  EXPECT_GT(std::sqrt(match.covariance(0, 0)), 0.07);
  EXPECT_LT(std::sqrt(match.covariance(1, 1)), 0.01);
}

TEST(MapMatch, KeepsTheMotionWithoutSupport) {
  const SurfaceMap empty{GridDrawingConfig{}};
  const UncertainPose prior{{1.0, 2.0, 0.5}, motionCovariance(0.02, 0.01)};
  const auto points = pointsToMatch(scanOf(test::flat(), {}, 1));
  for (const auto& some : {points, std::vector<OrientedPoint>{}}) {
    const MapMatch match = matchToMap(empty, some, prior);
    EXPECT_EQ(match.T_map_body.x_m, 1.0);
    EXPECT_EQ(match.support, 0.0);
    EXPECT_TRUE(match.covariance.isApprox(prior.covariance, 1e-9));
    EXPECT_TRUE(std::isfinite(match.log_likelihood));
  }
}

}  // namespace
}  // namespace swiftlet::perception
