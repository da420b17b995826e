// How far a robot moves until it is localized, from nothing, and how long it takes to refuse a map of another building.
// SWIFTLET_FOUND_CASES sets the number of buildings; the figures of docs/localization.md are for 50.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include <gtest/gtest.h>

#include "tests/localization/like_buildings.hpp"
#include "tests/localization/lost_cases.hpp"

namespace swiftlet::test {
namespace {

using common::Pose2;

struct Found {
  double path_length_m = -1.0;  ///< Path length until it was first localized; negative if it never was.
  bool wrong = false;           ///< Wrong at that moment or later.
  double refused_s = -1.0;      ///< When the map was first refused; negative if it never was.
  bool believed_while_refused = false;
};

Building changed(Building building, double disturbed_share, std::uint64_t seed) {
  if (disturbed_share > 0.0) building.world = changedFurniture(building, disturbed_share, seed);
  return building;
}

/// A walk of 30 s, or until some time after a wrong map was refused. `told`: the robot is given a place in the map at
/// the start.
Found walk(const Building& mapped, const Building& building, std::uint64_t seed,
           const std::optional<Pose2>& told = std::nullopt, bool wrong_map = false) {
  const Walks walks(building);
  Walker walker(walks, seed);
  DriftingOdometry odometry(seed);
  common::RandomStream noise(seed, "found");
  perception::Localizer localizer(mapOf(mapped), Pose2{}, {}, seed);
  if (told) localizer.startAt(*told, common::planarCovariance(0.1, 0.05));
  Found found;
  double path_length_m = 0.0;
  constexpr int kScans = 300, kAfterRefusal = 50;
  int last = kScans;
  for (int i = 0; i < last; ++i) {
    const Pose2 truth = walker.pose();
    const auto scan = levelScan(building.world, truth, common::Time::fromSeconds(kScan_s * i), noise);
    const auto estimate = localizer.add({scan, odometry.pose(), Eigen::Matrix3d::Zero(), true, false});
    if (estimate.state == perception::LocalizationState::kLocalized) {
      if (found.path_length_m < 0.0) found.path_length_m = path_length_m;
      found.believed_while_refused |= estimate.refuted;
      const Pose2 off = between(truth, estimate.T_map_body);
      found.wrong |= off.position_m().norm() > kWrong_m || std::abs(off.yaw_rad) > kWrong_rad;
    }
    if (wrong_map && estimate.refuted) last = std::min(last, i + kAfterRefusal);
    if (estimate.refuted && found.refused_s < 0.0) found.refused_s = kScan_s * i;
    walker.advance(kScan_s);
    const Pose2 moved = between(truth, walker.pose());
    odometry.step(moved);
    path_length_m += moved.position_m().norm();
  }
  return found;
}

struct Count {
  int cases = 0, within_5_m = 0, wrong = 0, never = 0, refused = 0;
  std::vector<double> path_lengths_m;
};

using MakeBuilding = Building (*)(std::uint64_t seed);
Building someOffices(std::uint64_t seed) { return offices(seed); }

Count count(MakeBuilding make, const char* name, double disturbed_share, int cases) {
  Count count;
  for (int i = 0; i < cases; ++i) {
    const auto seed = 2001 + static_cast<std::uint64_t>(i);
    const Building building = make(seed);
    const Found found = walk(building, changed(building, disturbed_share, seed), seed);
    ++count.cases;
    count.within_5_m += found.path_length_m >= 0.0 && found.path_length_m <= 5.0 ? 1 : 0;
    count.wrong += found.wrong ? 1 : 0;
    count.refused += found.refused_s >= 0.0 ? 1 : 0;
    count.never += found.path_length_m < 0.0 ? 1 : 0;
    if (found.path_length_m >= 0.0) count.path_lengths_m.push_back(found.path_length_m);
  }
  std::sort(count.path_lengths_m.begin(), count.path_lengths_m.end());
  std::printf(
      "%s, %2.0f %% disturbed: %d cases, %d within 5 m, median %.1f m, at most %.1f m, never %d, wrong %d, map refused "
      "%d\n",
      name, 100.0 * disturbed_share, count.cases, count.within_5_m,
      count.path_lengths_m.empty() ? 0.0 : count.path_lengths_m[count.path_lengths_m.size() / 2],
      count.path_lengths_m.empty() ? 0.0 : count.path_lengths_m.back(), count.never, count.wrong, count.refused);
  return count;
}

TEST(Found, LocalizesWithinAFewMetresAndNeverAtAWrongPlace) {
  const char* asked = std::getenv("SWIFTLET_FOUND_CASES");
  const int cases = asked ? std::atoi(asked) : 8;
  for (const double disturbed_share : {0.0, 0.20}) {
    const Count counted = count(someOffices, "offices", disturbed_share, cases);
    EXPECT_EQ(counted.wrong, 0);
    EXPECT_EQ(counted.refused, 0);
    EXPECT_GE(counted.within_5_m, (disturbed_share > 0.0 ? 0.8 : 0.9) * cases - 1.0);
  }
}

/// Halls, and offices in which more has changed, to this laser of 12 m: only with SWIFTLET_FOUND_CASES, as they take
/// long.
TEST(Found, SeldomRefusesTheRightMapWhereMuchHasChanged) {
  const char* asked = std::getenv("SWIFTLET_FOUND_CASES");
  if (asked == nullptr) GTEST_SKIP() << "set SWIFTLET_FOUND_CASES";
  const int cases = std::atoi(asked);
  EXPECT_LE(count(someOffices, "offices", 0.35, cases).refused, 0.3 * cases);
  for (const double disturbed_share : {0.0, 0.20})
    EXPECT_LE(count(hall, "halls", disturbed_share, cases).refused, 0.2 * cases);
}

/// The place in the wrong map is believed, because it was given, until it is lost.
TEST(Found, RefusesMostMapsOfAnotherBuildingThatWereBelieved) {
  const int cases = 3;
  int refused = 0;
  for (int i = 0; i < cases; ++i) {
    const auto seed = 2001 + static_cast<std::uint64_t>(i);
    const Building mapped = offices(seed + 5000);
    const Pose2 told{mapped.inside_m.x(), mapped.inside_m.y(), 0.3 * i};
    const Found found = walk(mapped, changed(hall(seed), 0.20, seed), seed, told, true);
    refused += found.refused_s >= 0.0 ? 1 : 0;
    std::printf("another building, believed: refused after %.1f s\n", found.refused_s);
  }
  EXPECT_GE(refused, 0.75 * cases);
}

/// The walks of as many seeds through changed buildings whose map is another one's.
int refusedIn20s(const char* name, MakeBuilding mapped, MakeBuilding flown, int cases) {
  int in_time = 0;
  for (int i = 0; i < cases; ++i) {
    const auto seed = 2001 + static_cast<std::uint64_t>(i);
    const Found found = walk(mapped(seed), changed(flown(seed), 0.20, seed), seed, {}, true);
    EXPECT_FALSE(found.believed_while_refused) << "seed " << seed;
    in_time += found.refused_s >= 0.0 && found.refused_s <= 20.0 ? 1 : 0;
  }
  std::printf("%s: %d cases, refused within 20 s %d\n", name, cases, in_time);
  return in_time;
}

/// Bare offices look much alike to this laser of 12 m, so that some of these maps fit for long.
TEST(Found, RefusesMostWrongMapsWithin20Seconds) {
  const char* asked = std::getenv("SWIFTLET_FOUND_CASES");
  const int cases = asked ? std::atoi(asked) : 2;
  EXPECT_GE(refusedIn20s(
                "another building", [](std::uint64_t seed) { return offices(seed + 5000); }, hall, cases),
            0.75 * cases - 0.5);
  EXPECT_GE(refusedIn20s(
                "mirrored", [](std::uint64_t seed) { return mirrored(offices(seed)); }, someOffices, cases),
            0.6 * cases - 0.5);
  EXPECT_GE(refusedIn20s(
                "the other floor", [](std::uint64_t seed) { return offices(seed + 5000, outlineOf(offices(seed))); },
                someOffices, cases),
            0.6 * cases - 0.5);
}

}  // namespace
}  // namespace swiftlet::test
