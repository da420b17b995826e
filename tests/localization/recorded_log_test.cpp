// A recorded log of a wheeled robot in the map of its first part: localized from nothing, tracked, carried away,
// localized again. The truth is the trajectory of the map itself.
#include <cstdio>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "interfaces/laser_log/laser_log.hpp"
#include "interfaces/laser_log/open_laser_log.hpp"
#include "perception/localization/log_localizer.hpp"
#include "perception/slam2d/laser_slam.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/laser_log_profile.hpp"

namespace swiftlet::perception {
namespace {

namespace fs = std::filesystem;
using common::Pose2;

struct Mapped {
  std::vector<interfaces::LoggedScan> scans;
  std::vector<Pose2> poses;  ///< T_map_robot of each.
  common::OccupancyGrid map = common::makeOccupancyGrid(0.05);
};

Mapped mapOf(const fs::path& file, std::size_t count) {
  Mapped mapped;
  LaserSlam slam{test_support::laserLogSlam()};
  std::vector<TrackedScan> track;
  const auto log = interfaces::openLaserLog(file);
  while (mapped.scans.size() < count) {
    auto logged = log->next();
    if (!logged) break;
    const auto tracked = slam.add({logged->scan, logged->T_robot_laser, logged->T_odom_robot});
    if (!tracked) continue;
    track.push_back(*tracked);
    mapped.scans.push_back(std::move(*logged));
  }
  slam.finish();
  const std::vector<Pose2> keys = slam.keyPoses();
  for (const TrackedScan& scan : track) mapped.poses.push_back(scan.T_map_robot(keys));
  mapped.map = slam.map();
  return mapped;
}

TEST(RecordedLocalization, LocalizesTracksAndRelocalizesInIntel) {
  const auto file = test_support::dataSet("01-laser-slam/intel/intel.clf.bz2");
  if (!file) return;
  const Mapped mapped = mapOf(*file, 4000);
  ASSERT_EQ(mapped.scans.size(), 4000U);
  // 500 scans are left out while the robot moves; its wheels are reset to their values before.
  constexpr std::size_t kFrom = 2000, kTo = 2500;
  const Pose2 T_jump = *mapped.scans[kFrom - 1].T_odom_robot * mapped.scans[kTo].T_odom_robot->inverse();
  LogLocalizer localizer(mapped.map, Pose2{}, {test_support::laserLogFrontEnd(), {}}, 1);
  int localized = 0, wrong = 0, all = 0;
  double sum_m = 0.0;
  for (std::size_t i = 0; i < mapped.scans.size(); ++i) {
    if (i >= kFrom && i < kTo) continue;
    const interfaces::LoggedScan& scan = mapped.scans[i];
    const Pose2 T_odom_robot = i < kFrom ? *scan.T_odom_robot : T_jump * *scan.T_odom_robot;
    const auto estimate = localizer.add({scan.scan, scan.T_robot_laser, T_odom_robot});
    ++all;
    if (!estimate || estimate->state != LocalizationState::kLocalized) continue;
    const double error_m = (estimate->T_map_body.position_m() - mapped.poses[i].position_m()).norm();
    ++localized;
    wrong += error_m > 0.5 ? 1 : 0;
    sum_m += error_m;
  }
  std::printf("  %.1f %% localized, of these %d wrong by more than 0.5 m; mean error %.3f m\n", 100.0 * localized / all,
              wrong, sum_m / localized);
  EXPECT_GE(localized, 0.75 * all);
  EXPECT_LE(wrong, 20) << "a few scans until it is noticed that it was carried away";
  EXPECT_LE(sum_m / localized, 0.10);
}

}  // namespace
}  // namespace swiftlet::perception
