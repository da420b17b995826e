#include "perception/slam2d/loop_search.hpp"

#include <array>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "perception/slam2d/free_space_violation.hpp"
#include "tests/scan_matching/scenes.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// A room without symmetry, so that a scan fits only one pose, with or without an inner corner of two walls.
test::PlanarWorld room(bool divided) {
  test::PlanarWorld world;
  world.addPolyline(
      {{-4.0, -3.0}, {5.0, -3.0}, {5.0, 1.0}, {3.5, 1.0}, {3.5, 3.0}, {-1.0, 3.0}, {-1.0, 4.0}, {-4.0, 4.0}}, true);
  if (divided) world.addPolyline({{1.6, -3.0}, {1.6, 1.5}, {-2.5, 1.5}}, false);
  return world;
}

PlacedScan placedAt(const ProjectedScan& scan, const Pose2& pose) { return {&scan, pose}; }

TEST(FreeSpaceViolation, IsZeroForScansOfTheSameRoom) {
  const Pose2 a{-1.0, 0.0, 0.3}, b{0.5, -1.0, -2.0};
  const ProjectedScan from_a = test::scanAt(room(true), a, 1), from_b = test::scanAt(room(true), b, 2);
  const PlacedScan one[] = {placedAt(from_a, a)}, other[] = {placedAt(from_b, b)};
  EXPECT_LT(freeSpaceViolation(one, other, 20.0), 0.01);
}

TEST(FreeSpaceViolation, CountsAWallThatOnlyOneScanSaw) {
  const Pose2 a{-1.0, 0.0, 0.3}, b{0.5, -1.0, -2.0};
  const ProjectedScan from_a = test::scanAt(room(true), a, 1), from_b = test::scanAt(room(false), b, 2);
  const PlacedScan one[] = {placedAt(from_a, a)}, other[] = {placedAt(from_b, b)};
  const double share = freeSpaceViolation(one, other, 20.0);
  EXPECT_GT(share, 0.15);
  EXPECT_NEAR(freeSpaceViolation(other, one, 20.0), share, 1e-12);
  // Points beyond the greatest range do not count.
  EXPECT_EQ(freeSpaceViolation(one, other, 0.1), 0.0);
}

TEST(FreeSpaceViolation, IsZeroWithoutOverlap) {
  const Pose2 pose{-1.0, 0.0, 0.3};
  const ProjectedScan scan = test::scanAt(room(false), pose, 1), empty;
  const PlacedScan here[] = {placedAt(scan, pose)}, nothing[] = {placedAt(empty, pose)};
  const PlacedScan far[] = {placedAt(scan, {60.0, 0.0, 0.3})};
  EXPECT_EQ(freeSpaceViolation(here, far, 20.0), 0.0);
  EXPECT_EQ(freeSpaceViolation(here, nothing, 20.0), 0.0);
  EXPECT_EQ(freeSpaceViolation({}, {}, 20.0), 0.0);
}

/// A scan of points at one range, one point a degree.
ProjectedScan arc(double range_m, double from_deg, double to_deg) {
  ProjectedScan scan;
  for (double angle_deg = from_deg; angle_deg <= to_deg; angle_deg += 1.0) {
    const double angle_rad = angle_deg * common::kRadPerDeg;
    scan.points_level_m.push_back((range_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad))).cast<float>());
  }
  return scan;
}

TEST(FreeSpaceViolation, IgnoresPointsBesideTheFieldOfView) {
  const ProjectedScan forward = arc(8.0, -90.0, 90.0), wider = arc(8.0, -90.0, 92.0), wall = arc(3.0, 90.5, 91.5);
  const PlacedScan seen[] = {placedAt(wall, {})};
  EXPECT_EQ(freeSpaceViolation(std::array{placedAt(forward, {})}, seen, 20.0), 0.0);
  EXPECT_EQ(freeSpaceViolation(std::array{placedAt(wider, {})}, seen, 20.0), 1.0);
}

TEST(FreeSpaceViolation, AFullTurnHasNoEdge) {
  const ProjectedScan around = arc(8.0, -179.5, 179.5), wall = arc(3.0, 179.0, 181.0);
  EXPECT_EQ(freeSpaceViolation(std::array{placedAt(around, {})}, std::array{placedAt(wall, {})}, 20.0), 1.0);
}

/// Five key scans in one room and five in another, the second believed to be 1.5 m beside the first.
struct TwoVisits {
  TwoVisits(const test::PlanarWorld& first, const test::PlanarWorld& second)
      : TwoVisits([&](int key) -> const test::PlanarWorld& { return key < kEach ? first : second; }) {}
  /// `worldOf`: what key scan i sees.
  explicit TwoVisits(const std::function<const test::PlanarWorld&(int)>& worldOf) {
    for (int i = 0; i < 2 * kEach; ++i) {
      const Pose2 truth{-2.0 + 0.4 * (i % kEach), -0.5, 0.1};
      const auto scan = std::make_shared<ProjectedScan>(test::scanAt(worldOf(i), truth, static_cast<std::uint64_t>(i)));
      graph.keys.push_back({scan, i < kEach ? truth : Pose2{truth.x_m + 1.2, truth.y_m - 0.9, truth.yaw_rad}, {}, {}});
      if (i == 0) continue;
      const double sigma_m = i == kEach ? 1.0 : 0.01;
      graph.add({i - 1, i,
                 between(graph.keys[static_cast<std::size_t>(i - 1)].T_map_body, graph.keys.back().T_map_body),
                 Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, 1e-5).asDiagonal(), false});
    }
  }
  std::optional<FoundLoop> search() const {
    const std::vector<LoopCandidate> candidates = loopCandidates(graph, 2 * kEach - 1, config);
    EXPECT_FALSE(candidates.empty());
    return candidates.empty() ? std::nullopt : searchLoop(graph, 2 * kEach - 1, candidates.front(), config);
  }

  static constexpr int kEach = 5;
  SlamGraph graph;
  Slam2dConfig config;
};

TEST(LoopSearch, FindsARevisitedRoom) {
  const TwoVisits visits(room(false), room(false));
  const auto found = visits.search();
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->shift_m, 1.5, 0.05);
}

TEST(LoopSearch, RejectsARoomWithAnAdditionalWall) {
  TwoVisits visits(room(false), room(true));
  EXPECT_FALSE(visits.search());
  // Without the limit on free-space violations the two rooms would be taken for the same.
  visits.config.loops.max_free_space_violation = 1.0;
  EXPECT_TRUE(visits.search());
}

TEST(LoopSearch, AcceptsARoomDespiteTemporaryObstacles) {
  const test::PlanarWorld empty = room(false), divided = room(true);
  const TwoVisits visits([&](int key) -> const test::PlanarWorld& { return key == 3 || key == 8 ? divided : empty; });
  EXPECT_TRUE(visits.search());
}

}  // namespace
}  // namespace swiftlet::perception
