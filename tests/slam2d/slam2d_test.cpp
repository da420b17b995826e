#include "perception/slam2d/slam2d.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "tests/slam2d/flight.hpp"
#include "tests/slam2d/grid_bytes.hpp"
#include "tests/slam2d/ring.hpp"

namespace swiftlet::perception {
namespace {

using common::CellIndex;
using common::Pose2;
using common::Time;

/// The errors of a flight, against the truth.
struct Score {
  double rms_m = 0.0, max_m = 0.0, end_m = 0.0;
  double odom_end_m = 0.0;
  double wall_median_m = 0.0, wall_p90_m = 0.0;
  double odometry_nees = 0.0;  ///< Mean normalized squared error of the relative poses; 3 when exact.
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

TEST(Slam2d, ThreeLoopsThroughTheFlatStayAccurate) {
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
  EXPECT_EQ(test::bytesOf(a.snapshot()), test::bytesOf(b.snapshot()));
  ASSERT_EQ(a.keyPoses().size(), b.keyPoses().size());
  for (std::size_t i = 0; i < a.keyPoses().size(); ++i)
    EXPECT_EQ(a.keyPoses()[i].T_map_body.x_m, b.keyPoses()[i].T_map_body.x_m);
}

TEST(Slam2d, ASnapshotDoesNotChange) {
  Slam2d slam{{}};
  test::Flight flight = flatFlight(1, 6);
  for (int i = 0; i < 100; ++i) {
    const auto step = flight.next();
    slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last);
  }
  const common::OccupancyGrid snapshot = slam.snapshot();
  const auto before = test::bytesOf(snapshot);
  for (int i = 0; i < 100; ++i) {
    const auto step = flight.next();
    slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last);
  }
  EXPECT_EQ(test::bytesOf(snapshot), before);
  EXPECT_NE(test::bytesOf(slam.snapshot()), before);
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

TEST(Slam2d, ClosesALoopAndRedrawsTheMap) {
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

TEST(Slam2d, AReturnToKnownAreaOptimizesTheGraph) {
  // The graph is too certain for a loop search. The end of the round is known area, and its scans are matched to it.
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

TEST(Slam2d, ATaskMayRunInTheBackgroundAndArriveLate) {
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
  // The correction also moved the part flown meanwhile.
  const Pose2 a = at_once.keyPoses().back().T_map_body, b = late.keyPoses().back().T_map_body;
  EXPECT_LT((a.position_m() - b.position_m()).norm(), 0.15);
}

TEST(Slam2d, IgnoresLateEmptyAndInvalidScans) {
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

/// An invalid covariance means that the step is unknown, not that it is certain.
TEST(Slam2d, AnInvalidCovarianceGivesAWeakEdge) {
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

}  // namespace
}  // namespace swiftlet::perception
