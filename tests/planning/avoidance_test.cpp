// The reactive layer as stories, tick by tick: what the laser sees, what the vehicle may do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "avoidance_story.hpp"
#include "common/config_check.hpp"
#include "grid_builder.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::planning {
namespace {

using common::Pose2;
using test::kHull_m;
using test::kTick_s;
using test::Point;
using test::Story;
using test_support::HasProblem;
using testing::HasSubstr;

TEST(Avoidance, DoesNotLimitTheSpeedInOpenSpace) {
  Story story;
  const AvoidanceDecision d = story.sense({0.5, 0});
  EXPECT_EQ(d.speed_limit_m_s, Avoidance::Config().max_speed_m_s);
  EXPECT_FALSE(d.retreat_velocity_level_m_s);
  EXPECT_FALSE(d.status.braking);
  EXPECT_NEAR(d.status.nearest_m, 4.0 - kHull_m, 0.06);
}

TEST(Avoidance, FliesSlowlyOutsideTheViewOfTheLaser) {
  Story story;
  const Avoidance::Config config;
  EXPECT_EQ(story.sense({0.8, 0.0}).speed_limit_m_s, config.max_speed_m_s);
  EXPECT_EQ(story.sense({-0.1, 0.8}).speed_limit_m_s, config.max_speed_m_s) << "the side is seen";
  EXPECT_EQ(story.sense({-0.8, 0.1}).speed_limit_m_s, config.blind_speed_m_s);
}

/// No beam meets what is behind the vehicle.
TEST(Avoidance, StopsBeforeAMappedWallThatTheLaserDoesNotSee) {
  Story story;
  for (int i = 0; i < 800; ++i) story.tick({-0.8, 0.0});
  EXPECT_LT(story.velocity_map_m_s.norm(), 0.02);
  EXPECT_GT(story.pose.x_m - kHull_m, 0.02);
  EXPECT_LT(story.pose.x_m - kHull_m, 0.15);
  EXPECT_EQ(story.retreats, 0);
  story.pose = {0.28, 4.0, std::numbers::pi};
  EXPECT_EQ(story.sense({0.8, 0.0}).speed_limit_m_s, Avoidance::Config::blind_speed_m_s) << "away from it, backwards";
}

TEST(Avoidance, AMapInWhichItsPlaceIsNotKnownDoesNotBrake) {
  Story story;
  story.pose = {0.38, 4.0, 0.0};
  EXPECT_LT(story.sense({-0.8, 0.0}).speed_limit_m_s, 0.9 * Avoidance::Config::blind_speed_m_s);
  story.position_sigma_m = 0.5;
  EXPECT_EQ(story.sense({-0.8, 0.0}).speed_limit_m_s, Avoidance::Config::blind_speed_m_s);
}

TEST(Avoidance, StopsBeforeAWallFromFullSpeed) {
  Story story;
  for (int i = 0; i < 600; ++i) story.tick({1.5, 0});
  EXPECT_LT(story.velocity_map_m_s.norm(), 0.02);
  EXPECT_GT(10.0 - story.pose.x_m - kHull_m, 0.02);
  EXPECT_LT(10.0 - story.pose.x_m - kHull_m, 0.15);
  EXPECT_EQ(story.retreats, 0);  // the wall is known
}

TEST(Avoidance, StopsBeforeAWallWithScansThatAreLate) {
  for (const double age_s : {0.1, 0.2}) {
    Story story;
    story.age_s = age_s;
    for (int i = 0; i < 600; ++i) story.tick({1.5, 0});
    EXPECT_LT(story.velocity_map_m_s.norm(), 0.02) << age_s;
    EXPECT_GT(10.0 - story.pose.x_m - kHull_m, 0.005) << age_s;
    EXPECT_LT(10.0 - story.pose.x_m - kHull_m, 0.15) << age_s;
    EXPECT_EQ(story.retreats, 0) << age_s;
  }
}

/// The beams that pass above it end on the wall behind it, at both sides of each of its points.
TEST(Avoidance, StopsBeforeATableThatTheBeamsPassAbove) {
  for (const AvoidanceBinRange range : {AvoidanceBinRange::kRobustMinimum, AvoidanceBinRange::kMean}) {
    Avoidance::Config config;
    config.bin_range = range;
    Story story(200, 160, config);
    for (double y = 3.6; y <= 4.4; y += 0.05) story.below_the_beams_map_m.emplace_back(7.0, y);
    for (int i = 0; i < 400; ++i) story.tick({1.0, 0});
    EXPECT_GT(7.0 - story.pose.x_m - kHull_m, 0.15) << "it is not in the map of the story: the vehicle backs off";
    EXPECT_LT(7.0 - story.pose.x_m - kHull_m, 0.5);
  }
}

TEST(Avoidance, ALateScanTakesSpeedAheadButNoRoomAtTheSides) {
  double last_m_s = 10.0;
  for (const double age_s : {0.0, 0.1, 0.2}) {
    Story story;
    Avoidance avoidance({}, kHull_m);
    story.pose = {8.9, 4.0, 0.0};
    const auto points = story.scan();
    const auto limit = [&](const Point& wanted) {
      return avoidance.update({story.now, points, wanted, wanted, story.pose, &story.map().clearance(), {}, age_s})
          .speed_limit_m_s;
    };
    const double ahead_m_s = limit({0.6, 0.0});
    EXPECT_LT(ahead_m_s, last_m_s) << age_s;
    // v (latency + lag + age) + v^2 / 2a is the free distance ahead.
    const Avoidance::Config config;
    const double free_m =
        ahead_m_s * (config.latency_s + config.lag_s + age_s) + 0.5 * ahead_m_s * ahead_m_s / config.deceleration_m_s2;
    EXPECT_NEAR(free_m, 10.0 - 8.9 - kHull_m - config.margin_m, 0.06) << age_s;
    last_m_s = ahead_m_s;
  }
}

/// A wall across the room with a door of 0.8 m in its middle, 0.125 m wider on each side than the hull.
void addDoor(Story& story) {
  story.addWall({{140, 0}, {142, 72}});
  story.addWall({{140, 88}, {142, 160}});
}

TEST(Avoidance, FliesThroughADoorOfEightyCentimetresWithLateScans) {
  for (const double age_s : {0.0, 0.2}) {
    for (const double off_m : {-0.05, 0.05}) {
      Story story;
      addDoor(story);
      story.age_s = age_s;
      story.pose.y_m += off_m;
      double slowest_m_s = 10.0;
      for (int i = 0; i < 240; ++i) {
        story.tick({0.6, 0});
        if (story.pose.x_m > 6.5 && story.pose.x_m < 7.5)
          slowest_m_s = std::min(slowest_m_s, story.velocity_map_m_s.x());
      }
      EXPECT_GT(story.pose.x_m, 8.0) << age_s << " s, " << off_m << " m";
      EXPECT_GT(slowest_m_s, 0.45) << age_s << " s, " << off_m << " m";
      EXPECT_EQ(story.retreats, 0) << age_s << " s, " << off_m << " m";
      EXPECT_GT(story.least_wall_m, 0.04) << age_s << " s, " << off_m << " m";
    }
  }
}

TEST(Avoidance, AWallAtThePlannersClearanceDoesNotBrake) {
  Story story;
  story.pose.y_m = kHull_m + 0.10;
  const AvoidanceDecision d = story.sense({1.0, 0});
  EXPECT_GE(d.speed_limit_m_s, 1.4);
  EXPECT_FALSE(d.retreat_velocity_level_m_s);
  // Towards the wall: not allowed.
  EXPECT_LT(story.sense({0, -1.0}).speed_limit_m_s, 0.3);
  // Inside the margin it may still move along the wall and away from it.
  story.pose.y_m = kHull_m + 0.02;
  EXPECT_GT(story.sense({0, 1.0}).speed_limit_m_s, 1.0);
  EXPECT_EQ(story.sense({0, -1.0}).speed_limit_m_s, 0.0);
}

TEST(Avoidance, TheRobustMinimumSeesAThinPoleThatTheMeanHides) {
  Avoidance::Config mean, robust;
  mean.bin_range = Avoidance::BinRange::kMean;
  for (const double distance_m : {0.8, 1.2, 1.6}) {
    Story story;
    story.pose = {2.0, 4.0, 0.0};
    story.poles.push_back({{2.0 + distance_m, 4.02}, {0, 0}, 0.015});
    const auto points = story.scan();
    const auto at = [&](const Avoidance::Config& config) {
      double least_m = 30.0;
      for (const Bin& bin : Avoidance::bins(config, Avoidance::smoothed(config, points)))
        if (std::abs(bin.bearing_rad) < 0.1) least_m = std::min(least_m, bin.range_m);
      return least_m;
    };
    EXPECT_NEAR(at(robust), distance_m - 0.015, 0.02);
    EXPECT_GT(at(mean), distance_m + 1.0);
    Story braking(200, 160, robust), blind(200, 160, mean);
    braking.pose = blind.pose = story.pose;
    braking.poles = blind.poles = story.poles;
    EXPECT_LT(braking.sense({1.5, 0}).speed_limit_m_s, 1.5);
    EXPECT_GE(blind.sense({1.5, 0}).speed_limit_m_s, 1.4);
  }
}

/// A sector that returned nothing has no place, whatever was in the memory before.
TEST(Avoidance, SectorsWithoutReturnsHaveNoNearestPlace) {
  for (int again = 0; again < 20; ++again) {
    {
      const std::vector<Bin> dirty(static_cast<std::size_t>(Avoidance::Config().bins),
                                   Bin{0.0, 1.0, Point(1e-9, 1e-9)});
    }
    for (const Bin& bin : Avoidance::bins({}, {})) {
      EXPECT_TRUE(bin.nearest_level_m.isZero());
      EXPECT_TRUE(std::isinf(bin.range_m));
    }
  }
}

TEST(Avoidance, BrakesOnlyIntentsFasterThanTheLimit) {
  Story story;
  story.pose = {5.0, 7.4, 0.0};  // 0.6 m from the wall.
  EXPECT_TRUE(story.sense({0, 1.0}).status.braking);
  EXPECT_FALSE(story.sense({0, 0}).status.braking) << "a hover beside it";
  EXPECT_FALSE(story.sense({0.3, 0}).status.braking) << "slowly along it";
}

TEST(Avoidance, OneStrayReturnDoesNotBrake) {
  Story story;
  auto points = story.scan();
  points[540] = {0.5f, 0.0f};
  points[300] = {NAN, NAN};
  Avoidance avoidance({}, kHull_m);
  const AvoidanceDecision d =
      avoidance.update({story.now, points, {0.5, 0}, {0.5, 0}, story.pose, &story.map().clearance(), {}});
  EXPECT_FALSE(d.status.braking);
}

TEST(Avoidance, RetreatsDirectlyAwayFromACloseUnmappedObject) {
  Story story;
  story.people.push_back({{5.0 + kHull_m + 0.25 + 0.15, 4.0}, {0, 0}});
  AvoidanceDecision d;
  for (int i = 0; i < 5; ++i) d = story.tick({0, 0});
  ASSERT_TRUE(d.retreat_velocity_level_m_s);
  EXPECT_LT(d.retreat_velocity_level_m_s->x(), -0.15);
  EXPECT_LT(std::abs(d.retreat_velocity_level_m_s->y()), 0.1);
  EXPECT_THAT(d.status.reason, HasSubstr("unmapped"));
  for (int i = 0; i < 200; ++i) d = story.tick({0, 0});
  EXPECT_FALSE(d.status.retreating);
  EXPECT_EQ(story.retreats, 1);
  EXPECT_GT((story.people[0].place_map_m - story.pose.position_m()).norm() - 0.25 - kHull_m, 0.25);
}

TEST(Avoidance, ARetreatDoesNotBackIntoAWallTheLaserDoesNotSee) {
  Story story;
  story.addWall({{80, 50}, {84, 110}});  // 0.5 m behind the hull's centre
  story.pose = {4.2 + kHull_m + 0.10, 4.0, 0.0};
  story.people.push_back({{story.pose.x_m + kHull_m + 0.25 + 0.15, 4.0}, {0, 0}});
  for (int i = 0; i < 200; ++i) story.tick({0, 0});
  EXPECT_GE(story.retreats, 1);
  EXPECT_GT(story.least_wall_m, 0.02);
  EXPECT_GT(story.least_gap_m, 0.0);
}

TEST(Avoidance, YieldsToAPersonWhoCrosses) {
  // Crossing 1.5 m ahead at 1 m/s, from either side, at any phase.
  for (const double side : {-1.0, 1.0}) {
    for (double phase_m = 0.5; phase_m <= 3.0; phase_m += 0.25) {
      Story story;
      story.beams = 361;
      story.live_map = side > 0.0;
      story.pose = {2.0, 4.0, 0.0};
      story.velocity_map_m_s = {0.8, 0};
      story.people.push_back({{3.5, 4.0 + side * phase_m}, {0, -side * 1.0}});
      for (int i = 0; i < 480; ++i) story.tick({0.8, 0});
      EXPECT_GT(story.least_gap_m, 0.05) << side << ' ' << phase_m;
      EXPECT_GT(story.pose.x_m, 3.5) << "it goes on afterwards " << side << ' ' << phase_m;
    }
  }
}

TEST(Avoidance, AvoidsAPersonWhoWalksTowardsIt) {
  for (const double aside_m : {-0.3, -0.1, 0.0, 0.1, 0.3}) {
    Story story;
    story.beams = 361;
    story.live_map = aside_m >= 0.0;
    story.pose = {3.0, 4.0, 0.0};
    story.people.push_back({{6.5, 4.0 + aside_m}, {-1.0, 0}});
    for (int i = 0; i < 280; ++i) story.tick({0, 0});
    EXPECT_GT(story.least_gap_m, 0.0) << aside_m;
    EXPECT_GE(story.retreats, 1);
    EXPECT_GT(story.least_wall_m, 0.02);
  }
}

// In a dead end one person is enough, in the open two are not: a descent is for where nothing is free.
TEST(Avoidance, SaysThatNothingIsFreeInADeadEndOnly) {
  const auto said = [](bool dead_end) {
    Story story;
    story.pose = {8.9, 4.0, std::numbers::pi};
    if (dead_end) {
      story.addWall({{120, 66}, {200, 70}});  // Between y = 3.5 m and 4.5 m, as far as x = 10 m.
      story.addWall({{120, 90}, {200, 94}});
    }
    story.people = {{{5.5, 4.0}, {1.0, 0.0}}};
    int ticks = 0;
    for (double t = 0.0; t < 3.0; t += kTick_s) ticks += !story.tick(Point::Zero()).nothing_free.empty();
    return ticks;
  };
  EXPECT_GT(said(true), 12) << "for 0.3 s at least";
  EXPECT_EQ(said(false), 0);
}

TEST(Avoidance, RemembersAPersonBehindIt) {
  // Seen while it passed from the front to the side, then in the rear 90 deg: the memory prevents a flight backwards.
  Story story;
  story.pose = {5.0, 4.0, 0.0};
  story.people.push_back({{4.1, 3.1}, {-0.0, 0.0}});
  for (int i = 0; i < 20; ++i) story.tick({0, 0});
  story.pose.yaw_rad = 0.9;  // now the person stands behind, unseen
  const auto points = story.scan();
  for (const auto& p : points)
    ASSERT_GT((story.pose * Point(p.cast<double>()) - story.people[0].place_map_m).norm(), 0.3);
  const Point back = (story.people[0].place_map_m - story.pose.position_m()).normalized();
  for (int i = 0; i < 40; ++i) story.tick(0.5 * back);
  EXPECT_GT(story.least_gap_m, 0.05);
}

/// The bearing of a direction in the map, as the vehicle of the story sees it.
double bearing_deg(const Story& story, const Point& direction_map) {
  const Point level = Eigen::Rotation2Dd(-story.pose.yaw_rad) * direction_map;
  return std::atan2(level.y(), level.x()) * 180.0 / std::numbers::pi;
}

TEST(Avoidance, TurnsUntilItSeesTheObjectItRetreatsFrom) {
  // A person comes from the edge of the laser's view.
  Story story;
  const double from_rad = 125.0 * std::numbers::pi / 180.0;
  const Point from(std::cos(from_rad), std::sin(from_rad));
  story.people.push_back({story.pose.position_m() + 2.5 * from, -0.8 * from});
  bool turned = false;
  for (int i = 0; i < 120; ++i) {
    const AvoidanceDecision d = story.tick({0, 0});
    turned |= d.status.retreating;
    story.pose.yaw_rad += std::clamp(d.turn_rad.value_or(0.0), -kTick_s, kTick_s);
  }
  ASSERT_TRUE(turned);
  EXPECT_LT(std::abs(bearing_deg(story, story.people[0].place_map_m - story.pose.position_m())), 110.0);
  EXPECT_GT(story.least_gap_m, 0.05);
}

TEST(Avoidance, TurnsItsSideToAnApproachingPersonToSeeItsEscape) {
  Story story;
  story.people.push_back({{7.5, 4.02}, {-0.5, 0}});
  int moving = 0;
  for (int i = 0; i < 160; ++i) {
    const AvoidanceDecision d = story.tick({0, 0});
    story.pose.yaw_rad += std::clamp(d.turn_rad.value_or(0.0), -kTick_s, kTick_s);
    if (!d.status.retreating) continue;
    EXPECT_LT(std::abs(bearing_deg(story, story.people[0].place_map_m - story.pose.position_m())), 135.0) << i;
    // A course that begins behind it is in view after the turn, of 65 deg.
    if (story.velocity_map_m_s.norm() < 0.2 || ++moving < 50) continue;
    EXPECT_LT(std::abs(bearing_deg(story, story.velocity_map_m_s)), 135.0) << i;
  }
  EXPECT_GT(moving, 20);
  EXPECT_GT(story.least_gap_m, 0.05);
}

TEST(Avoidance, DoesNotRetreatFromMappedObstacles) {
  Story story(60, 30);  // 3 m by 1.5 m
  for (double y = kHull_m + 0.10; y <= 1.5 - kHull_m - 0.10; y += 0.1) {
    story.pose = {1.5, y, 0.3};
    EXPECT_FALSE(story.sense({0.3, 0}).retreat_velocity_level_m_s) << y;
  }
}

/// It believes that it stands still, and drifts towards a wall that its map has.
TEST(Avoidance, DoesNotDriftIntoAMappedWallWhenThePositionIsUncertain) {
  for (const double sigma_m : {0.05, 0.5}) {
    Story story;
    story.pose.x_m = 8.8;
    story.position_sigma_m = sigma_m;
    story.unknown_velocity_map_m_s = {0.2, 0.0};
    for (int i = 0; i < 400; ++i) story.tick({0, 0});
    if (sigma_m > 0.1)
      EXPECT_GT(story.least_wall_m, 0.0);
    else
      EXPECT_LT(story.least_wall_m, 0.0) << "a known position does not drift: the test tests nothing";
  }
}

/// The correction of a wrong position drives it at a wall that the map has, faster than any intent would.
TEST(Avoidance, RetreatsFromAWallThatItCannotStopBefore) {
  for (const double speed_m_s : {0.3, 0.9}) {
    Story story;
    story.pose.x_m = 9.4;
    story.velocity_map_m_s = {speed_m_s, 0.0};
    const AvoidanceDecision d = story.sense({0.0, 0.0});
    EXPECT_EQ(d.retreat_velocity_level_m_s.has_value(), speed_m_s > 0.5) << d.status.reason;
    if (d.retreat_velocity_level_m_s) {
      EXPECT_LT(d.retreat_velocity_level_m_s->x(), 0.05);
      EXPECT_THAT(d.status.reason, HasSubstr("too fast"));
    }
  }
}

TEST(Avoidance, FliesThroughADoorOfEightyCentimetresWithAnUncertainPosition) {
  Story story;
  addDoor(story);
  story.position_sigma_m = 0.5;
  for (int i = 0; i < 240; ++i) story.tick({0.6, 0});
  EXPECT_GT(story.pose.x_m, 8.0);
  EXPECT_EQ(story.retreats, 0);
}

TEST(Avoidance, DoesNotSwitchBackAndForthNearTheRetreatDistance) {
  Story story;
  story.people.push_back({{5.0 + kHull_m + 0.25 + 0.26, 4.0}, {0, 0}});
  for (int i = 0; i < 400; ++i) {
    // A person who moves about the retreat distance.
    story.people[0].velocity_map_m_s = {0.1 * std::sin(i * 0.1), 0.0};
    story.tick({0, 0});
  }
  EXPECT_LE(story.retreats, 2);
}

TEST(Avoidance, BrakesWithoutAMap) {
  Story story;
  story.pose = {9.4, 4.0, 0.0};
  const auto points = story.scan();
  Avoidance avoidance({}, kHull_m);
  const AvoidanceDecision d = avoidance.update({story.now, points, {1, 0}, {1, 0}, story.pose, nullptr, {}});
  EXPECT_LT(d.speed_limit_m_s, 0.8);
  EXPECT_FALSE(d.retreat_velocity_level_m_s);
  EXPECT_EQ(avoidance.update({story.now, {}, {1, 0}, {1, 0}, story.pose, nullptr, {}}).speed_limit_m_s,
            Avoidance::Config().max_speed_m_s);
}

TEST(Avoidance, RefusesMarginsThatForbidTheClearance) {
  Avoidance::Config config;
  EXPECT_TRUE(common::config::problemsOf(config).empty());
  EXPECT_TRUE(config.validateAgainst(0.10, 0.25).empty());
  ASSERT_EQ(config.validateAgainst(0.05, 0.25).size(), 2u);
  EXPECT_THAT(config.validateAgainst(0.05, 0.25), HasProblem("avoidance.margin", "margin_m", "0.05 m"));
  config.retreat_distance_m = 0.45;
  ASSERT_EQ(config.validateAgainst(0.10, 0.25).size(), 1u);
  EXPECT_THAT(config.validateAgainst(0.10, 0.25),
              HasProblem("avoidance.retreat-distance", "retreat_distance_m", "0.35 m"));
}

}  // namespace
}  // namespace swiftlet::planning
