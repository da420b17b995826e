// Stories of a robot that does not know where it is, scan by scan. Truth is seen by the scoring alone.
#include <algorithm>
#include <cstdio>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/LU>

#include "perception/localization/localizer.hpp"
#include "tests/localization/lost_cases.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using common::Time;
using test_support::MessageIs;
using ::testing::Optional;

/// A robot that moves through a building with an odometry of its own.
struct Story {
  explicit Story(const test::Building& building_in, std::uint64_t seed, const LocalizerConfig& config = {})
      : building(building_in),
        walks(building),
        walker(walks, seed),
        odometry(seed),
        noise(seed, "story"),
        localizer(test::mapOf(building), Pose2{}, config, seed) {}

  LocalizationEstimate step(bool fresh = true) {
    const auto scan = test::levelScan(building.world, walker.pose(), Time::fromSeconds(time_s), noise);
    truth = walker.pose();
    odometry_at_scan = odometry.pose();
    auto estimate = localizer.add({scan, odometry.pose(), Eigen::Matrix3d::Zero(), fresh, false});
    walker.advance(0.1);
    const Pose2 moved = between(truth, walker.pose());
    odometry.step(moved);
    path_length_m += moved.position_m().norm();
    time_s += 0.1;
    return estimate;
  }

  const test::Building building;
  test::Walks walks;
  test::Walker walker;
  test::DriftingOdometry odometry;
  common::RandomStream noise;
  Localizer localizer;
  Pose2 truth, odometry_at_scan;
  double time_s = 0.0, path_length_m = 0.0;
};

double errorOf(const LocalizationEstimate& estimate, const Pose2& truth) {
  return (estimate.T_map_body.position_m() - truth.position_m()).norm();
}

TEST(Localizer, LocalizesWithinAFewMetresAndStaysLocalized) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Story story(test::offices(seed), seed);
    double found_m = -1.0, worst_m = 0.0;
    for (int i = 0; i < 150; ++i) {
      const auto estimate = story.step();
      if (estimate.state != LocalizationState::kLocalized) {
        EXPECT_LT(found_m, 0.0) << "lost again, seed " << seed;
        continue;
      }
      if (found_m < 0.0) found_m = story.path_length_m;
      worst_m = std::max(worst_m, errorOf(estimate, story.truth));
    }
    EXPECT_GE(found_m, LocalizerConfig{}.confirm_distance_m) << seed;
    EXPECT_LE(found_m, 5.0) << seed;
    EXPECT_LE(worst_m, 0.3) << seed;
  }
}

/// A robot that comes into the mapped building from another one, of which it has no map.
TEST(Localizer, SearchesLessOftenOutsideTheMapAndLocalizesAfterReturning) {
  const test::Building elsewhere = test::hall(3), mapped = test::offices(3);
  Localizer localizer(test::mapOf(mapped), Pose2{}, {}, 3);
  common::RandomStream noise(3, "elsewhere");
  double walked_m = 0.0;
  std::vector<double> searched_at_m;
  Pose2 T_odom_body;
  const auto walkIn = [&](const test::Building& building, double length_m) {
    const test::Walks walks(building);
    test::Walker walker(walks, 3);
    const double until_m = walked_m + length_m;
    auto state = LocalizationState::kGlobal;
    while (walked_m < until_m && state != LocalizationState::kLocalized) {
      const Pose2 from = walker.pose();
      const Time stamp = Time::fromSeconds(walked_m / 0.7);
      localizer.follow({test::levelScan(building.world, from, stamp, noise), T_odom_body, {}, true, false});
      if (const auto task = localizer.takeTask()) {
        searched_at_m.push_back(walked_m);
        localizer.apply(run(*task));
      }
      state = localizer.state();
      walker.advance(0.1);
      const Pose2 moved = between(from, walker.pose());
      T_odom_body = T_odom_body * moved;
      walked_m += std::max(moved.position_m().norm(), 0.001);
    }
    return state;
  };
  EXPECT_NE(walkIn(elsewhere, 60.0), LocalizationState::kLocalized);
  const auto searches = [&](double from_m, double to_m) {
    return std::count_if(searched_at_m.begin(), searched_at_m.end(),
                         [&](double at_m) { return at_m >= from_m && at_m < to_m; });
  };
  EXPECT_GE(searches(0.0, 8.0), 15) << "each 0.4 m at first";
  EXPECT_LE(searches(40.0, 60.0), 4);
  const double home_m = walked_m;
  EXPECT_EQ(walkIn(mapped, 30.0), LocalizationState::kLocalized);
  // The next search may be 12 m away, and what it sees of the building elsewhere is forgotten by the one after.
  EXPECT_LE(walked_m - home_m, 25.0);
  std::printf("  %td searches in 60 m elsewhere; found %.1f m after it came back\n", searches(0.0, home_m),
              walked_m - home_m);
}

/// The errors agree with the covariance, within a factor.
TEST(Localizer, ItsCovarianceAgreesWithItsErrors) {
  Story story(test::offices(4), 4);
  story.localizer.startAt(story.walker.pose(), Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal());
  double normalized = 0.0;
  int count = 0;
  for (int i = 0; i < 200; ++i) {
    const auto estimate = story.step();
    ASSERT_EQ(estimate.state, LocalizationState::kLocalized);
    if (i < 20 || i % 5 != 0) continue;
    const Eigen::Vector2d error = estimate.T_map_body.position_m() - story.truth.position_m();
    normalized += error.dot(estimate.covariance.topLeftCorner<2, 2>().inverse() * error);
    ++count;
  }
  EXPECT_LT(normalized / count, 3.0 * 2.0);  // The mean is 2 if the covariance is exact.
  EXPECT_GT(normalized / count, 2.0 / 20.0);
}

TEST(Localizer, IsAmbiguousBetweenTwoIdenticalPlaces) {
  const test::Building building = test::twinWings(2);
  Story story(building, 2);
  // Up and down one wing: nothing distinguishes it from the other.
  for (int i = 0; i < 80; ++i) {
    story.walker.carry({6.0 + 0.06 * i, 0.05}, 0.0);
    if (i == 0) continue;
    const Pose2 pose = story.walker.pose();
    const auto scan = test::levelScan(building.world, pose, Time::fromSeconds(0.1 * i), story.noise);
    const auto estimate = story.localizer.add({scan, Pose2{0.06 * i, 0.0, 0.0}, Eigen::Matrix3d::Zero(), true, false});
    EXPECT_NE(estimate.state, LocalizationState::kLocalized) << i;
  }
  EXPECT_EQ(story.localizer.state(), LocalizationState::kAmbiguous);
}

TEST(Localizer, WeighsOnlyWithScansThatTheOdometryDidNotUse) {
  Story story(test::offices(5), 5);
  story.localizer.startAt(story.walker.pose(), Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal());
  EXPECT_FALSE(story.localizer.wantsFreshScan(story.odometry.pose())) << "nothing is known of the odometry yet";
  const auto first = story.step(false);
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(story.localizer.wantsFreshScan(story.odometry.pose()));
    const auto estimate = story.step(false);
    EXPECT_EQ(estimate.T_map_odom.x_m, first.T_map_odom.x_m) << "moved by a scan of the odometry";
  }
  // A scan that the odometry did not use moves the particles. At rest nothing new is seen, so no further scan is due.
  EXPECT_NE(story.step(true).T_map_odom.x_m, first.T_map_odom.x_m);
  const Pose2 here = story.odometry_at_scan;
  EXPECT_FALSE(story.localizer.wantsFreshScan(here));
  EXPECT_TRUE(story.localizer.wantsFreshScan(here * Pose2{0.3, 0.0, 0.0}));
  EXPECT_TRUE(story.localizer.wantsFreshScan(here * Pose2{0.0, 0.0, 0.4}));
}

/// Without scans that the odometry did not use the pose becomes less and less certain, until it is given up.
TEST(Localizer, GivesUpAPoseAfterLongOdometryWithoutScans) {
  LocalizerConfig config;
  config.odometry_share = 0.5;
  config.max_sigma_m = 0.15;
  Story story(test::offices(5), 5, config);
  story.localizer.startAt(story.walker.pose(), Eigen::Vector3d(0.01, 0.01, 0.0001).asDiagonal());
  story.step(true);
  LocalizationEstimate estimate;
  for (int i = 0; i < 300 && story.localizer.state() == LocalizationState::kLocalized; ++i)
    estimate = story.step(false);
  ASSERT_TRUE(estimate.event);
  EXPECT_EQ(estimate.state, LocalizationState::kLost);
  EXPECT_NE(estimate.event->reason.find("uncertain by"), std::string::npos) << estimate.event->reason;
}

/// Turned on the spot, unnoticed by its odometry: the distance alone would not show the error.
TEST(Localizer, ReportsTheErrorOfTheHeadingWhenThePositionIsRight) {
  Story story(test::offices(5), 5);
  story.localizer.startAt(story.walker.pose(), Eigen::Vector3d(0.01, 0.01, 0.0001).asDiagonal());
  for (int i = 0; i < 20; ++i) story.step();
  const Pose2 before = story.walker.pose();
  story.walker.carry(before.position_m(), before.yaw_rad + 0.7);
  LocalizationEstimate estimate;
  for (int i = 0; i < 20 && !estimate.event; ++i) estimate = story.step();
  ASSERT_TRUE(estimate.event);
  EXPECT_EQ(estimate.state, LocalizationState::kLost);
  EXPECT_NE(estimate.event->reason.find("turned by 4"), std::string::npos) << estimate.event->reason;
}

TEST(Localizer, TheSameSeedGivesIdenticalResults) {
  std::vector<double> first;
  for (int run = 0; run < 2; ++run) {
    Story story(test::offices(6), 6);
    std::vector<double> all;
    for (int i = 0; i < 60; ++i) {
      const auto estimate = story.step();
      for (const double v : {estimate.T_map_body.x_m, estimate.T_map_body.yaw_rad, estimate.covariance(0, 1)})
        all.push_back(v);
    }
    if (run == 0) first = all;
    EXPECT_EQ(first, all);
  }
}

/// The searches of a story, each applied `late` scans after it was asked for.
struct LateSearches {
  LocalizationEstimate step(Story& story, int late) {
    const auto scan =
        test::levelScan(story.building.world, story.walker.pose(), Time::fromSeconds(story.time_s), story.noise);
    story.truth = story.walker.pose();
    auto estimate = story.localizer.follow({scan, story.odometry.pose(), Eigen::Matrix3d::Zero(), true, false});
    if (estimate.event) reasons.push_back(estimate.event->reason);
    if (auto task = story.localizer.takeTask()) {
      EXPECT_FALSE(result) << "one at a time";
      result = run(*task);
      due = late;
    }
    if (result && due-- <= 0) {
      estimate = story.localizer.apply(*result);
      result.reset();
      if (estimate.event) reasons.push_back(estimate.event->reason);
    }
    story.walker.advance(0.1);
    story.odometry.step(between(story.truth, story.walker.pose()));
    story.time_s += 0.1;
    return estimate;
  }
  std::optional<LocalizationResult> result;
  int due = 0;
  std::vector<std::string> reasons;
};

TEST(Localizer, AnImmediateBackgroundSearchEqualsASearchInTheLoop) {
  Story one(test::offices(2), 2), other(test::offices(2), 2);
  LateSearches searches;
  for (int i = 0; i < 150; ++i) {
    const auto a = one.step(), b = searches.step(other, 0);
    ASSERT_EQ(a.state, b.state) << "scan " << i;
    ASSERT_EQ(a.T_map_body.x_m, b.T_map_body.x_m) << "scan " << i;
    ASSERT_EQ(a.explained, b.explained) << "scan " << i;
  }
  EXPECT_EQ(one.localizer.state(), LocalizationState::kLocalized);
}

TEST(Localizer, ALateSearchResultIsMovedToThePresentPose) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Story story(test::offices(seed), seed);
    LateSearches searches;
    int localized = 0;
    for (int i = 0; i < 150; ++i) {
      const auto estimate = searches.step(story, 5);
      if (estimate.state != LocalizationState::kLocalized) continue;
      ++localized;
      EXPECT_LT(errorOf(estimate, story.truth), 0.35) << "seed " << seed << ", scan " << i;
    }
    EXPECT_GT(localized, 50) << "seed " << seed;
  }
}

TEST(Localizer, IgnoresASearchFromBeforeItWasGivenAPose) {
  Story story(test::offices(3), 3);
  LateSearches searches;
  while (!searches.result) searches.step(story, 1000);
  story.localizer.startAt(story.walker.pose(), Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal());
  EXPECT_EQ(story.localizer.apply(*searches.result).state, LocalizationState::kLocalized);
  EXPECT_FALSE(story.localizer.takeTask()) << "nothing is asked for";
}

/// Whether it was localized before or not, the path before the given start does not count.
TEST(Localizer, ContinuesFromAPoseGivenDuringTheWalk) {
  for (const int steps : {10, 150}) {
    Story story(test::offices(3), 3);
    for (int i = 0; i < steps; ++i) story.step(i < 100);
    story.localizer.startAt(story.walker.pose(), Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal());
    for (int i = 0; i < 10; ++i) {
      const auto estimate = story.step();
      ASSERT_EQ(estimate.state, LocalizationState::kLocalized) << i;
      EXPECT_LT(errorOf(estimate, story.truth), 0.25) << steps << " " << i;
    }
  }
}

/// The odometry jitters and the view stays the same. The robot has not moved far enough to confirm a place.
TEST(Localizer, IsNeverLocalizedAtRest) {
  for (const std::uint64_t seed : {1U, 2U, 6U, 7U}) {
    const test::Building building = test::offices(seed);
    Story story(building, seed);
    common::RandomStream tremble(seed, "tremble");
    const Pose2 pose = story.walker.pose();
    for (int i = 0; i < 600; ++i) {
      const auto scan = test::levelScan(building.world, pose, Time::fromSeconds(0.1 * i), story.noise);
      const Pose2 odometry{tremble.gaussian(0.005), tremble.gaussian(0.005), tremble.gaussian(0.003)};
      const auto estimate = story.localizer.add({scan, odometry, Eigen::Matrix3d::Zero(), true, false});
      ASSERT_NE(estimate.state, LocalizationState::kLocalized) << seed << " " << i;
    }
  }
}

TEST(Localizer, SupportsAGridThatIsRotatedInTheMap) {
  const test::Building building = test::offices(7);
  const Pose2 T_map_grid{10.0, -4.0, 0.7};
  test::Walks walks(building);
  test::Walker walker(walks, 7);
  Localizer localizer(test::mapOf(building), T_map_grid, {}, 7);
  localizer.startAt(T_map_grid * walker.pose(), Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal());
  common::RandomStream noise(7, "turned");
  test::DriftingOdometry odometry(7);
  for (int i = 0; i < 50; ++i) {
    const auto scan = test::levelScan(building.world, walker.pose(), Time::fromSeconds(0.1 * i), noise);
    const auto estimate = localizer.add({scan, odometry.pose(), Eigen::Matrix3d::Zero(), true, false});
    ASSERT_EQ(estimate.state, LocalizationState::kLocalized);
    EXPECT_LT(errorOf(estimate, T_map_grid * walker.pose()), 0.25);
    const Pose2 before = walker.pose();
    walker.advance(0.1);
    odometry.step(between(before, walker.pose()));
  }
}

TEST(Localizer, RefusesMapsWithoutFreeCellsAndMapsThatAreTooLarge) {
  common::OccupancyGrid map = common::makeOccupancyGrid(0.05);
  map.set({0, 0}, common::occupancy::kMaxSteps);
  EXPECT_THAT(Localizer::whyUnusable(map), Optional(MessageIs("map.no-free-cells")));
  map.set({1, 0}, -common::occupancy::kMaxSteps);
  EXPECT_EQ(Localizer::whyUnusable(map), std::nullopt);
  map.set({39'999, 29'999}, -common::occupancy::kMaxSteps);
  EXPECT_THAT(Localizer::whyUnusable(map), Optional(MessageIs("map.too-large", "40000 x 30000 cells")));
}

/// Scans without points, points that are not numbers, time that goes back: nothing breaks, and no pose is invented.
TEST(Localizer, ToleratesBadScans) {
  Story story(test::offices(8), 8);
  story.localizer.startAt(story.walker.pose(), Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal());
  for (int i = 0; i < 30; ++i) story.step();
  ProjectedScan nothing;
  nothing.stamp = Time::fromSeconds(1.0);
  EXPECT_EQ(story.localizer.add({nothing, story.odometry.pose(), Eigen::Matrix3d::Zero(), true, false}).state,
            LocalizationState::kLocalized);
  ProjectedScan nans = nothing;
  nans.points_level_m.assign(90, Eigen::Vector2f(NAN, 1.0F));
  (void)story.localizer.add({nans, story.odometry.pose(), Eigen::Matrix3d::Zero(), true, false});
  for (int i = 0; i < 10; ++i) {
    const auto estimate = story.step();
    EXPECT_EQ(estimate.state, LocalizationState::kLocalized);
    EXPECT_LT(errorOf(estimate, story.truth), 0.3);
  }
}

/// An odometry that is briefly not a valid pose, or has an invalid covariance.
TEST(Localizer, ToleratesBadOdometry) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  Story story(test::offices(8), 8);
  story.localizer.startAt(story.walker.pose(), Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal());
  for (int i = 0; i < 30; ++i) story.step();
  const auto add = [&](const Pose2& T_odom_body, double variance) {
    const auto scan =
        test::levelScan(story.building.world, story.walker.pose(), Time::fromSeconds(story.time_s += 0.1), story.noise);
    return story.localizer.add({scan, T_odom_body, Eigen::Matrix3d::Identity() * variance, true, false});
  };
  const Pose2 here = story.odometry.pose();
  for (const double bad : {kNan, kInf, -kInf}) {
    for (const Pose2& pose : {Pose2{bad, here.y_m, here.yaw_rad}, Pose2{here.x_m, here.y_m, bad}}) {
      const auto estimate = add(pose, 0.0);
      EXPECT_EQ(estimate.state, LocalizationState::kLocalized);
      EXPECT_LT(errorOf(estimate, story.truth), 0.5);
    }
  }
  EXPECT_EQ(add(here, kNan).state, LocalizationState::kLocalized);
  LocalizationEstimate estimate;
  for (int i = 0; i < 40; ++i) estimate = story.step();
  EXPECT_EQ(estimate.state, LocalizationState::kLocalized);
  EXPECT_TRUE(estimate.covariance.allFinite());
  EXPECT_LT(errorOf(estimate, story.truth), 0.3);
}

/// The odometry may be interrupted while inputs are skipped; the interruption must still take effect.
TEST(Localizer, AnInterruptionWithoutAPoseTakesEffect) {
  Story story(test::offices(8), 8);
  story.localizer.startAt(story.walker.pose(), Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal());
  for (int i = 0; i < 30; ++i) story.step();
  ProjectedScan nothing;
  const Eigen::Matrix3d none = Eigen::Matrix3d::Zero();
  (void)story.localizer.add({nothing, Pose2{NAN, 0.0, 0.0}, none, true, true});
  EXPECT_GT(story.step(false).covariance(0, 0), 0.1);
}

}  // namespace
}  // namespace swiftlet::perception
