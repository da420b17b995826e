// How far a robot moves until it is localized, from nothing. SWIFTLET_FOUND_CASES sets the number of buildings; the
// table of docs/localization.md is for 50.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/localization/lost_cases.hpp"

namespace swiftlet::test {
namespace {

using common::Pose2;

struct Found {
  double path_length_m = -1.0;  ///< Path length until it was first localized; negative if it never was.
  bool wrong = false;           ///< Wrong at that moment or later.
};

Found walk(const Building& mapped, const PlanarWorld& world, std::uint64_t seed) {
  Building building = mapped;
  building.world = world;
  const Walks walks(building);
  Walker walker(walks, seed);
  DriftingOdometry odometry(seed);
  common::RandomStream noise(seed, "found");
  perception::Localizer localizer(mapOf(mapped), Pose2{}, {}, seed);
  Found found;
  double path_length_m = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Pose2 truth = walker.pose();
    const auto scan = levelScan(world, truth, common::Time::fromSeconds(kScan_s * i), noise);
    const auto estimate = localizer.add({scan, odometry.pose(), Eigen::Matrix3d::Zero(), true, false});
    if (estimate.state == perception::LocalizationState::kLocalized) {
      if (found.path_length_m < 0.0) found.path_length_m = path_length_m;
      const Pose2 off = between(truth, estimate.T_map_body);
      found.wrong |= off.position_m().norm() > kWrong_m || std::abs(off.yaw_rad) > kWrong_rad;
    }
    walker.advance(kScan_s);
    const Pose2 moved = between(truth, walker.pose());
    odometry.step(moved);
    path_length_m += moved.position_m().norm();
  }
  return found;
}

struct Count {
  int cases = 0, within_5_m = 0, wrong = 0, never = 0;
  std::vector<double> path_lengths_m;
};

Count count(double disturbed_share, int cases) {
  Count count;
  for (int i = 0; i < cases; ++i) {
    const auto seed = 2001 + static_cast<std::uint64_t>(i);
    const Building building = offices(seed);
    const Found found = walk(
        building, disturbed_share > 0.0 ? changedFurniture(building, disturbed_share, seed) : building.world, seed);
    ++count.cases;
    count.within_5_m += found.path_length_m >= 0.0 && found.path_length_m <= 5.0 ? 1 : 0;
    count.wrong += found.wrong ? 1 : 0;
    count.never += found.path_length_m < 0.0 ? 1 : 0;
    if (found.path_length_m >= 0.0) count.path_lengths_m.push_back(found.path_length_m);
  }
  std::sort(count.path_lengths_m.begin(), count.path_lengths_m.end());
  std::printf("%2.0f %% disturbed: %d cases, %d within 5 m, median %.1f m, at most %.1f m, never %d, wrong %d\n",
              100.0 * disturbed_share, count.cases, count.within_5_m,
              count.path_lengths_m.empty() ? 0.0 : count.path_lengths_m[count.path_lengths_m.size() / 2],
              count.path_lengths_m.empty() ? 0.0 : count.path_lengths_m.back(), count.never, count.wrong);
  return count;
}

TEST(Found, LocalizesWithinAFewMetresAndNeverAtAWrongPlace) {
  const char* asked = std::getenv("SWIFTLET_FOUND_CASES");
  const int cases = asked ? std::atoi(asked) : 8;
  for (const double disturbed_share : {0.0, 0.20}) {
    const Count counted = count(disturbed_share, cases);
    EXPECT_EQ(counted.wrong, 0);
    EXPECT_GE(counted.within_5_m, (disturbed_share > 0.0 ? 0.8 : 0.9) * cases - 1.0);
  }
}

}  // namespace
}  // namespace swiftlet::test
