#include "perception/slam2d/slam2d.hpp"

#include <ctime>

#include <gtest/gtest.h>

#include "tests/slam2d/flight.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

double cpuTime_us() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return t.tv_sec * 1e6 + t.tv_nsec * 1e-3;
}

struct Score {
  double rms_m = 0, max_m = 0, odom_end_m = 0, yaw_rms_deg = 0;
  double wall_median_m = 0, wall_p90_m = 0, wall_max_m = 0;
  SlamCounts counts;
};

Score fly(test::Flight flight, const Slam2dConfig& config, bool tasks = true) {
  Slam2d slam(config);
  double sum2 = 0, yaw2 = 0, odom2 = 0, slam_us = 0, slam_max = 0;
  int n = 0;
  Score score;
  const Pose2 T_world_map = flight.start();
  double nees = 0;
  int nees_n = 0;
  Pose2 truth_ref;
  while (!flight.done()) {
    const auto step = flight.next();
    if (step.relative) {
      if (step.relative->from != step.relative->to) {
        const Pose2 t = truth_ref.inverse() * step.truth_T_world_body;
        const Eigen::Vector3d e(step.relative->T_from_to.x_m - t.x_m, step.relative->T_from_to.y_m - t.y_m,
                                common::wrapAngle(step.relative->T_from_to.yaw_rad - t.yaw_rad));
        nees += e.dot(step.relative->covariance.ldlt().solve(e));
        ++nees_n;
      }
      if (step.relative->reference_changed) truth_ref = step.truth_T_world_body;
    }
    const auto t0 = cpuTime_us();
    const SlamUpdate u = slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last);
    const double us = cpuTime_us() - t0;
    slam_us += us;
    slam_max = std::max(slam_max, us);
    if (tasks)
      if (const auto task = slam.takeTask()) {
        const auto result = run(*task);
        for (auto& a : result.accepted) printf("loop %d-%d q %.2f shift %.3f\n", a.from, a.to, a.quality, a.shift_m);
        slam.apply(result);
      }
    const Pose2 error = step.truth_T_world_body.inverse() * (T_world_map * u.T_map_body);
    const Pose2 odom_error = step.truth_T_world_body.inverse() * (T_world_map * step.T_odom_body);
    sum2 += error.position_m().squaredNorm();
    odom2 += odom_error.position_m().squaredNorm();
    score.max_m = std::max(score.max_m, error.position_m().norm());
    yaw2 += error.yaw_rad * error.yaw_rad;
    ++n;
    score.odom_end_m = odom_error.position_m().norm();
  }
  score.rms_m = std::sqrt(sum2 / n);
  std::vector<double> d;
  const auto grid = slam.snapshot();
  grid.forEachCell([&](common::CellIndex c, common::occupancy::Cell v) {
    if (common::occupancy::isOccupied(v)) d.push_back(flight.world().distanceToWall(T_world_map * grid.centerOf(c)));
  });
  std::sort(d.begin(), d.end());
  score.counts = slam.counts();
  const auto o = flight.odometry().counts();
  printf(
      "n %d rms %.1f mm max %.1f mm yaw %.3f deg | odom rms %.1f end %.1f mm nees %.2f | walls: %zu cells median %.1f "
      "p90 %.1f max %.1f mm | slam %.0f us mean %.0f max\n",
      n, 1e3 * score.rms_m, 1e3 * score.max_m, std::sqrt(yaw2 / n) * 57.3, 1e3 * std::sqrt(odom2 / n),
      1e3 * score.odom_end_m, nees / nees_n, d.size(), 1e3 * d[d.size() / 2], 1e3 * d[d.size() * 9 / 10],
      1e3 * d.back(), slam_us / n, slam_max);
  printf(
      "  odo: scans %lu fail %lu refs %lu restarts %lu | slam keys %lu local %lu failed %lu loops %lu/%lu rejected "
      "%lu\n",
      o.scans, o.failures, o.references, o.restarts, score.counts.key_scans, score.counts.local_matches,
      score.counts.local_failures, score.counts.loops_closed, score.counts.loop_candidates,
      score.counts.loops_rejected);
  return score;
}

TEST(Slam2d, SeveralLoopsThroughTheFlat) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed)
    fly(test::Flight(test::flat(), test::SmoothPath(test::flatLoop(1), 1.0), {}, seed), {});
}

}  // namespace
}  // namespace swiftlet::perception
