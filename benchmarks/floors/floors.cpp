// benchmark_floors: the SLAM on floors drawn at random, with wheels and without.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "benchmarks/floors/floor_drive.hpp"
#include "common/table.hpp"
#include "evaluation/trajectory_metrics.hpp"
#include "perception/slam2d/laser_slam.hpp"
#include "tests/slam2d/tracked_path.hpp"
#include "tests/support/laser_log_profile.hpp"

namespace {

using namespace swiftlet;

/// RMS of the positions after planar alignment.
double trajectoryError_m(const benchmarks::FloorDrive& drive, bool odometry,
                         const perception::LaserSlamConfig& config) {
  perception::LaserSlam slam(config);
  test::TrackedPath path(slam);
  for (const auto& [scan, T_odom_robot] : drive.scans)
    path.add(scan.stamps.measured, {scan, {}, odometry ? std::optional(T_odom_robot) : std::nullopt});
  return evaluation::absoluteTrajectoryError(evaluation::associate(path.finish(), drive.truth),
                                             evaluation::Alignment::kPlanar)
      .value()
      .translation_m.rmse;
}

void driveFloors(std::uint64_t first, int count, const perception::LaserSlamConfig& config) {
  common::Table table{"RMS error of the trajectory, m", {"floor", "scans", "wheels", "none"}, {}};
  double log_sum = 0.0;
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(count); ++seed) {
    const auto drive = benchmarks::makeFloorDrive(benchmarks::makeFloorPlan(seed), seed);
    const double with_m = trajectoryError_m(drive, true, config);
    const double without_m = trajectoryError_m(drive, false, config);
    log_sum += std::log(with_m) + std::log(without_m);
    table.rows.push_back({{fmt::format("{}", seed)},
                          {fmt::format("{}", drive.scans.size())},
                          {fmt::format("{:.3f}", with_m)},
                          {fmt::format("{:.3f}", without_m)}});
    std::fprintf(stderr, "floor %d: done\n", static_cast<int>(seed));
  }
  std::printf("%sGeometric mean of all: %.3f m\n", toText(table).c_str(), std::exp(log_sum / (2.0 * count)));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The SLAM on floors drawn at random, with wheels and without"};
  std::uint64_t first = 1;
  int count = 8;
  perception::LaserSlamConfig config = test_support::laserLogSlam();
  app.add_option("--first", first, "Seed of the first floor")->capture_default_str();
  app.add_option("--count", count, "How many floors")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--max-free-space-violation", config.slam.loops.max_free_space_violation,
                 "Greatest share of a closure that violates free space; 1: any")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  driveFloors(first, count, config);
  return 0;
}
