#include "perception/slam2d/slam2d.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "perception/slam2d/sliced_map.hpp"
#include "tests/slam2d/flight.hpp"
#include "tests/slam2d/ring.hpp"

namespace swiftlet::perception {
namespace {

using common::CellIndex;
using common::Pose2;
using common::Time;

/// How a flight went, against the truth.
struct Score {
  double rms_m = 0.0, max_m = 0.0, end_m = 0.0;
  double odom_end_m = 0.0;
  double wall_median_m = 0.0, wall_p90_m = 0.0;
  double odometry_nees = 0.0;  ///< Mean normalized squared error of the relative poses; 3 when honest.
};

/// Distances of the occupied cells from the nearest wall, sorted.
std::vector<double> wallErrors(const common::OccupancyGrid& grid, const test::PlanarWorld& world,
                               const Pose2& T_world_map) {
  std::vector<double> errors;
  grid.forEachCell([&](CellIndex c, common::occupancy::Cell value) {
    if (common::occupancy::isOccupied(value)) errors.push_back(world.distanceToWall(T_world_map * grid.centerOf(c)));
  });
  std::sort(errors.begin(), errors.end());
  return errors;
}

Score fly(test::Flight flight, Slam2d& slam) {
  Score score;
  const Pose2 T_world_map = flight.start();
  Pose2 truth_of_reference;
  int scans = 0, relatives = 0;
  while (!flight.done()) {
    const auto step = flight.next();
    const SlamUpdate update = slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last);
    if (const auto task = slam.takeTask()) slam.apply(run(*task));
    const double error_m =
        ((T_world_map * update.T_map_body).position_m() - step.truth_T_world_body.position_m()).norm();
    score.rms_m += error_m * error_m;
    score.max_m = std::max(score.max_m, error_m);
    score.end_m = error_m;
    score.odom_end_m = ((T_world_map * step.T_odom_body).position_m() - step.truth_T_world_body.position_m()).norm();
    ++scans;
    if (!step.relative) continue;
    if (step.relative->from != step.relative->to) {
      const Pose2 truth = truth_of_reference.inverse() * step.truth_T_world_body;
      const Eigen::Vector3d e(step.relative->T_from_to.x_m - truth.x_m, step.relative->T_from_to.y_m - truth.y_m,
                              common::wrapAngle(step.relative->T_from_to.yaw_rad - truth.yaw_rad));
      score.odometry_nees += e.dot(step.relative->covariance.ldlt().solve(e));
      ++relatives;
    }
    if (step.relative->reference_changed) truth_of_reference = step.truth_T_world_body;
  }
  score.rms_m = std::sqrt(score.rms_m / scans);
  score.odometry_nees /= relatives;
  const std::vector<double> walls = wallErrors(slam.snapshot(), flight.world(), T_world_map);
  score.wall_median_m = walls[walls.size() / 2];
  score.wall_p90_m = walls[walls.size() * 9 / 10];
  printf(
      "  rms %.1f mm, max %.1f, end %.1f, odometry end %.1f; walls median %.1f, p90 %.1f mm; nees %.2f; %d key scans\n",
      1e3 * score.rms_m, 1e3 * score.max_m, 1e3 * score.end_m, 1e3 * score.odom_end_m, 1e3 * score.wall_median_m,
      1e3 * score.wall_p90_m, score.odometry_nees, static_cast<int>(slam.counts().key_scans));
  return score;
}

test::Flight flatFlight(int loops, std::uint64_t seed) {
  return {test::flat(), test::SmoothPath(test::flatLoop(loops), 1.0), {}, seed};
}

std::vector<int> bytesOf(const common::OccupancyGrid& grid) {
  std::vector<int> bytes;
  grid.forEachCell([&](CellIndex c, common::occupancy::Cell value) {
    if (value != grid.background()) bytes.insert(bytes.end(), {c.x, c.y, value});
  });
  return bytes;
}

TEST(Slam2d, ThreeLoopsThroughTheFlat) {
  for (const std::uint64_t seed : {1U, 2U}) {
    Slam2d slam{{}};
    const Score score = fly(flatFlight(3, seed), slam);
    EXPECT_LT(score.rms_m, 0.015);
    EXPECT_LT(score.max_m, 0.05);
    EXPECT_LT(score.end_m, 0.03);  // The third loop is as good as the first.
    EXPECT_LT(score.wall_median_m, 0.025);
    EXPECT_LT(score.wall_p90_m, 0.05);
    EXPECT_GT(score.odometry_nees, 0.5);
    EXPECT_LT(score.odometry_nees, 5.0);
    EXPECT_EQ(slam.counts().local_failures, 0U);
  }
}

TEST(Slam2d, TheGraphDoesNotGrowInKnownArea) {
  Slam2d once{{}}, thrice{{}};
  fly(flatFlight(1, 3), once);
  fly(flatFlight(3, 3), thrice);
  EXPECT_LT(thrice.counts().key_scans, 2 * once.counts().key_scans);
}

TEST(Slam2d, TheSameFlightGivesTheSameBytes) {
  Slam2d a{{}}, b{{}};
  fly(flatFlight(1, 5), a);
  fly(flatFlight(1, 5), b);
  EXPECT_EQ(bytesOf(a.snapshot()), bytesOf(b.snapshot()));
  ASSERT_EQ(a.keyPoses().size(), b.keyPoses().size());
  for (std::size_t i = 0; i < a.keyPoses().size(); ++i)
    EXPECT_EQ(a.keyPoses()[i].T_map_body.x_m, b.keyPoses()[i].T_map_body.x_m);
}

TEST(Slam2d, ASnapshotStaysAsItWas) {
  Slam2d slam{{}};
  test::Flight flight = flatFlight(1, 6);
  for (int i = 0; i < 100; ++i) {
    const auto step = flight.next();
    slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last);
  }
  const common::OccupancyGrid snapshot = slam.snapshot();
  const auto before = bytesOf(snapshot);
  for (int i = 0; i < 100; ++i) {
    const auto step = flight.next();
    slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last);
  }
  EXPECT_EQ(bytesOf(snapshot), before);
  EXPECT_NE(bytesOf(slam.snapshot()), before);
}

double worstKey(const Slam2d& slam, const std::vector<std::pair<Time, Pose2>>& truth) {
  double worst_m = 0.0;
  std::size_t i = 0;
  for (const auto& key : slam.keyPoses()) {
    while (i + 1 < truth.size() && truth[i].first < key.stamp) ++i;
    worst_m = std::max(worst_m, (key.T_map_body.position_m() - truth[i].second.position_m()).norm());
  }
  return worst_m;
}

TEST(Slam2d, ClosesALoopAndDrawsTheMapAnew) {
  const test::Ring ring;
  Slam2dConfig deaf;
  deaf.loops.max_candidates = 0;
  Slam2d closing{{}}, open{deaf};
  std::vector<std::pair<Time, Pose2>> truth;
  double jump_m = 0.0;
  ring.fly(1.15, [&](const ProjectedScan& scan, const Pose2& T_odom_body, const Eigen::Matrix3d& covariance,
                     const Pose2& at) {
    truth.emplace_back(scan.stamp, at);
    open.addScan(scan, T_odom_body, covariance);
    closing.addScan(scan, T_odom_body, covariance);
    EXPECT_FALSE(open.takeTask());
    if (const auto task = closing.takeTask()) {
      const Pose2 before = closing.T_map_odom() * T_odom_body;
      const SlamResult result = run(*task);
      EXPECT_TRUE(closing.apply(result) || result.accepted.empty());
      jump_m = std::max(jump_m, ((closing.T_map_odom() * T_odom_body).position_m() - before.position_m()).norm());
    }
  });
  const double open_m = worstKey(open, truth), closed_m = worstKey(closing, truth);
  printf("  worst key scan: %.3f m open, %.3f m closed; %d of %d candidates; jump %.3f m\n", open_m, closed_m,
         static_cast<int>(closing.counts().loops_closed), static_cast<int>(closing.counts().loop_candidates), jump_m);
  EXPECT_GE(closing.counts().loops_closed, 1U);
  EXPECT_GT(jump_m, 0.08);
  EXPECT_LT(closed_m, 0.5 * open_m);
  EXPECT_LT(closed_m, 0.35);
}

TEST(Slam2d, AReturnOntoKnownGroundSettlesTheGraph) {
  // Too certain for a loop to be sought: the end of the round is known ground, and matched to it.
  const test::Ring ring;
  Slam2dConfig certain;
  certain.loops.max_candidates = 0;
  certain.edge_sigma_m = 0.0005;
  certain.edge_sigma_deg = 0.004;
  Slam2d slam{certain};
  std::vector<std::pair<Time, Pose2>> truth;
  int optimized = 0;
  double before_m = 0.0;
  ring.fly(
      1.15,
      [&](const ProjectedScan& scan, const Pose2& T_odom_body, const Eigen::Matrix3d&, const Pose2& at) {
        truth.emplace_back(scan.stamp, at);
        slam.addScan(scan, T_odom_body, Eigen::Vector3d(1e-7, 1e-7, 1e-9).asDiagonal());
        const auto task = slam.takeTask();
        if (!task) return;
        if (optimized == 0) before_m = worstKey(slam, truth);
        optimized += slam.apply(run(*task)) ? 1 : 0;
      },
      1.0003, 0.00003);
  const double after_m = worstKey(slam, truth);
  printf("  worst key scan: %.3f m before, %.3f m after; optimized %d times\n", before_m, after_m, optimized);
  EXPECT_GE(optimized, 1);
  EXPECT_GT(before_m, 0.05);
  EXPECT_LT(after_m, 0.5 * before_m);
}

TEST(Slam2d, ATaskMayRunElsewhereAndArriveLate) {
  const test::Ring ring;
  Slam2d at_once{{}}, late{{}};
  std::optional<SlamTask> pending;
  int waited = 0;
  ring.fly(1.1,
           [&](const ProjectedScan& scan, const Pose2& T_odom_body, const Eigen::Matrix3d& covariance, const Pose2&) {
             at_once.addScan(scan, T_odom_body, covariance);
             late.addScan(scan, T_odom_body, covariance);
             if (const auto task = at_once.takeTask()) at_once.apply(run(*task));
             if (!pending) {
               pending = late.takeTask();
               waited = 0;
             }
             if (pending) {
               EXPECT_FALSE(late.takeTask());
             }
             if (!pending || ++waited < 8) return;
             SlamResult here = run(*pending), there;
             std::thread([&] { there = run(*pending); }).join();
             ASSERT_EQ(here.accepted.size(), there.accepted.size());
             for (std::size_t i = 0; i < here.accepted.size(); ++i)
               EXPECT_EQ(here.accepted[i].T_from_to.x_m, there.accepted[i].T_from_to.x_m);
             late.apply(there);
             pending.reset();
           });
  ASSERT_GE(late.counts().loops_closed, 1U);
  // What was flown meanwhile went along with the correction.
  const Pose2 a = at_once.keyPoses().back().T_map_body, b = late.keyPoses().back().T_map_body;
  EXPECT_LT((a.position_m() - b.position_m()).norm(), 0.15);
}

TEST(Slam2d, IgnoresWhatIsLateEmptyOrNotANumber) {
  Slam2d slam{{}};
  EXPECT_FALSE(slam.addScan({}, {}, Eigen::Matrix3d::Zero()).key_scan);  // No points: the map does not begin here.
  test::Flight flight = flatFlight(1, 6);
  const auto step = flight.next();
  EXPECT_TRUE(slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last).key_scan);
  slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last);  // Again.
  const auto next = flight.next();
  slam.addScan(next.scan, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, next.covariance_since_last);
  EXPECT_EQ(slam.counts().ignored_scans, 3U);
  const Eigen::Matrix3d nan = Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(std::isfinite(slam.addScan(next.scan, next.T_odom_body, nan).T_map_body.x_m));
}

/// It says nothing of the step, not that the step is certain.
TEST(Slam2d, ACovarianceThatIsNotANumberMakesAWeakEdge) {
  const auto firstEdge = [](bool known) {
    Slam2d slam{{}};
    test::Flight flight = flatFlight(1, 6);
    while (slam.edges().empty()) {
      const auto step = flight.next();
      slam.addScan(step.scan, step.T_odom_body,
                   known ? step.covariance_since_last
                         : Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN()).eval());
    }
    return slam.edges().front().covariance;
  };
  EXPECT_LT(firstEdge(true)(0, 0), 0.01);
  EXPECT_GT(firstEdge(false)(0, 0), 0.2);
}

// --- The grid. ---

DrawnScan around(double radius_m, int beams) {
  DrawnScan scan;
  for (int i = 0; i < beams; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / beams;
    scan.hits_level_m.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.0);
  }
  return scan;
}

TEST(GridDrawing, FreeInsideOccupiedAtTheEndUnknownBeyond) {
  const GridDrawingConfig config;
  SlicedMap map(config);
  const Pose2 pose{0.51, -0.32, 0.4};
  for (int i = 0; i < 3; ++i) map.draw(around(2.0, 720), pose);
  const common::OccupancyGrid grid = map.atFlightHeight();
  int occupied = 0;
  grid.forEachCell([&](CellIndex c, common::occupancy::Cell value) {
    const double range_m = (grid.centerOf(c) - pose.position_m()).norm();
    EXPECT_TRUE(range_m > 1.9 || common::occupancy::isFree(value)) << c.x << ' ' << c.y;
    EXPECT_TRUE(range_m < 2.1 || common::occupancy::isUnknown(value)) << c.x << ' ' << c.y;
    occupied += common::occupancy::isOccupied(value) ? 1 : 0;
  });
  EXPECT_GT(occupied, 200);  // 2 pi 2 m / 5 cm = 251 cells.
}

TEST(GridDrawing, AWalkerIsClearedAgain) {
  const GridDrawingConfig config;
  SlicedMap map(config);
  DrawnScan person = around(3.0, 720);
  for (Eigen::Vector3f& p : person.hits_level_m)
    if (std::abs(std::atan2(p.y(), p.x())) < 0.15F) p *= 0.5F;
  for (int i = 0; i < 50; ++i) map.draw(person, {});
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(1.5, 0.0)); };
  EXPECT_EQ(where(), config.max_steps);  // Capped, however long they stood there.
  int scans = 0;
  for (; common::occupancy::isOccupied(where()) && scans < 100; ++scans) map.draw(around(3.0, 720), {});
  EXPECT_LE(scans, 12);
}

TEST(GridDrawing, WhatDoesNotChangeStaysShared) {
  const GridDrawingConfig config;
  SlicedMap map(config);
  for (int i = 0; i < 30; ++i) map.draw(around(1.0, 360), {});
  const common::OccupancyGrid before = map.atFlightHeight();
  map.draw(around(1.0, 360), {});
  EXPECT_EQ(before.tileIdentity({0, 0}), map.atFlightHeight().tileIdentity({0, 0}));
}

/// A wall of 3 m around, and in front of it something lower, which beams meet that point `below_m` down.
DrawnScan over(double below_m, double body_height_m) {
  DrawnScan scan = around(3.0, 720);
  scan.body_height_m = body_height_m;
  for (Eigen::Vector3f& p : scan.hits_level_m) {
    const bool ahead = std::abs(std::atan2(p.y(), p.x())) < 0.2F;
    if (ahead && below_m > 0.0) p *= 0.5F;
    if (ahead) p.z() = static_cast<float>(-below_m);
  }
  return scan;
}

TEST(GridDrawing, LevelBeamsDoNotEraseWhatIsLower) {
  SlicedMap map{GridDrawingConfig{}};
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(1.5, 0.0)); };
  for (int i = 0; i < 10; ++i) map.draw(over(0.0, 1.0), {});
  EXPECT_TRUE(common::occupancy::isFree(where()));
  map.draw(over(0.15, 1.0), {});  // A nod, one scan long.
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
  // Long enough to be met again on the way there; a trace that never is goes in the end.
  for (int i = 0; i < 50; ++i) map.draw(over(0.0, 1.0), {});
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
  for (int i = 0; i < 50; ++i) map.draw(over(0.0, 1.0), {});
  EXPECT_TRUE(common::occupancy::isFree(where()));
  // Just below the level beams it goes sooner: they dip there now and then.
  map.draw(over(0.06, 1.0), {});
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
  for (int i = 0; i < 25; ++i) map.draw(over(0.0, 1.0), {});
  EXPECT_TRUE(common::occupancy::isFree(where()));
}

/// What was kept up cell by cell while drawing is what all slices give when they are combined anew.
TEST(GridDrawing, TheMapAtFlightHeightIsThatOfItsSlices) {
  common::RandomStream random(1, "slices");
  SlicedMap map{GridDrawingConfig{}};
  for (int i = 0; i < 300; ++i) {
    DrawnScan scan = around(random.uniform(1.0, 3.0), 360);
    scan.body_height_m = random.uniform(0.7, 1.3);
    for (Eigen::Vector3f& p : scan.hits_level_m) p.z() = static_cast<float>(random.uniform(-0.4, 0.4));
    map.draw(scan, {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-3.0, 3.0)});
    if (i % 20 != 0) continue;
    const common::OccupancyGrid kept_up = map.atFlightHeight();
    ASSERT_TRUE(map.setFlightHeight(5.0));
    ASSERT_TRUE(map.setFlightHeight(1.0));
    const common::OccupancyGrid anew = map.atFlightHeight();
    int known = 0, different = 0;
    anew.forEachCell([&](CellIndex c, common::occupancy::Cell value) {
      known += common::occupancy::isUnknown(value) ? 0 : 1;
      if (i > 0) different += value == kept_up.at(c) ? 0 : 1;  // The first flight height is that of the first scan.
    });
    EXPECT_GT(known, 500);
    EXPECT_EQ(different, 0) << "after " << i + 1 << " scans";
  }
}

TEST(GridDrawing, WhatIsFarBelowTheHullIsNotInItsWayUntilItSinks) {
  SlicedMap map{GridDrawingConfig{}};
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(1.5, 0.0)); };
  for (int i = 0; i < 3; ++i) map.draw(over(0.0, 0.6), {});
  for (int i = 0; i < 3; ++i) map.draw(over(0.01, 0.6), {});  // Something as high as 0.6 m.
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
  EXPECT_TRUE(map.setFlightHeight(1.4));
  for (int i = 0; i < 3; ++i) map.draw(over(0.0, 1.4), {});  // From far above it.
  EXPECT_TRUE(common::occupancy::isFree(where()));
  map.draw(over(0.4, 1.4), {});  // A view that ends far below says that the hull's height is free.
  EXPECT_TRUE(common::occupancy::isFree(where()));
  EXPECT_TRUE(map.setFlightHeight(0.6));
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
}

TEST(GridDrawing, ThinsAndBoundsWhatItKeeps) {
  const GridDrawingConfig config;
  ProjectedScan scan;
  for (int i = 0; i < 1000; ++i) scan.points_level_m.emplace_back(1.0F, 0.001F * static_cast<float>(i));
  scan.points_level_m.emplace_back(100.0F, 0.0F);
  scan.points_level_m.emplace_back(3.0F, 0.0F);
  scan.heights_level_m.assign(1001, 0.0F);
  scan.heights_level_m.push_back(1.5F);  // Far above the body.
  scan.misses_level_m = {{0.0F, 30.0F, 0.0F}, {std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F}};
  const DrawnScan drawn = thinForDrawing(scan, config);
  EXPECT_LT(drawn.hits_level_m.size(), 60U);
  ASSERT_EQ(drawn.free_level_m.size(), 3U);
  EXPECT_NEAR(drawn.free_level_m[0].norm(), config.max_hit_range_m, 1e-3);
  EXPECT_NEAR(drawn.free_level_m[1].z(), config.max_height_above_m, 1e-6);  // Free as long as it was in the hull's way.
  EXPECT_NEAR(drawn.free_level_m[1].x(), 3.0 * config.max_height_above_m / 1.5, 1e-6);
  EXPECT_NEAR(drawn.free_level_m[2].norm(), config.max_free_range_m, 1e-3);
}

}  // namespace
}  // namespace swiftlet::perception
