// The yaw along a path: optimal against all sequences of choices, and what it means for vehicles that see differently.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "planning/search/yaw_planner.hpp"

namespace swiftlet::planning {
namespace {

using common::Facing;
using Point = Eigen::Vector2d;

constexpr double kDeg = common::kRadPerDeg;
const ViewAhead kLaser{135.0 * kDeg, std::nullopt, 0.275};
const ViewAhead kLaserAndCamera{135.0 * kDeg, 29.0 * kDeg, 0.275};
const ViewAhead kAllRound{std::numbers::pi, std::nullopt, 0.275};
/// As the default profile flies.
const YawTask kTask{0.0, std::nullopt, 0.0, 0.73, 0.8, 60.0 * kDeg};

double offCourse_rad(const std::vector<Facing>& facings, std::size_t i) {
  const Point step = facings[i + 1].place_m - facings[i].place_m;
  return std::abs(common::wrapAngle(facings[i].yaw_rad - std::atan2(step.y(), step.x())));
}

/// The whole turn along the path.
double turned_rad(const std::vector<Facing>& facings) {
  double sum_rad = 0.0;
  for (std::size_t i = 1; i < facings.size(); ++i)
    sum_rad += std::abs(common::wrapAngle(facings[i].yaw_rad - facings[i - 1].yaw_rad));
  return sum_rad;
}

/// The greatest turn between two places.
double greatestTurn_rad(const std::vector<Facing>& facings) {
  double most_rad = 0.0;
  for (std::size_t i = 1; i < facings.size(); ++i)
    most_rad = std::max(most_rad, std::abs(common::wrapAngle(facings[i].yaw_rad - facings[i - 1].yaw_rad)));
  return most_rad;
}

double cost_s(const YawPlanner& planner, const std::vector<YawPlanner::Place>& places,
              const std::vector<double>& yaws_rad, const YawTask& task) {
  double sum_s = 0.0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    sum_s += planner.step(places[i], yaws_rad[i], yaws_rad[i + 1], task).cost_s;
  return sum_s;
}

/// The least cost over all sequences of choices from a place on.
double leastCost_s(const YawPlanner& planner, const std::vector<YawPlanner::Place>& places, std::size_t at,
                   double yaw_rad, const YawTask& task) {
  if (at + 1 == places.size()) return 0.0;
  double least_s = std::numeric_limits<double>::infinity();
  const bool ends = at + 2 == places.size() && task.goal_yaw_rad;
  for (const double next_rad : ends ? std::vector{*task.goal_yaw_rad} : YawPlanner::choices(places[at + 1], task))
    least_s = std::min(least_s, planner.step(places[at], yaw_rad, next_rad, task).cost_s +
                                    leastCost_s(planner, places, at + 1, next_rad, task));
  return least_s;
}

YawTask randomTask(common::RandomStream& random) {
  YawTask task = kTask;
  task.yaw_rad = random.uniform(-3.1, 3.1);
  task.speed_m_s = random.uniform(0.2, 1.5);
  task.acceleration_m_s2 = random.uniform(0.3, 1.5);
  task.start_speed_m_s = random.uniform(0.0, task.speed_m_s);
  task.yaw_rate_rad_s = random.uniform(0.3, 2.0);
  if (random.chance(0.5)) task.goal_yaw_rad = random.uniform(-3.1, 3.1);
  return task;
}

ViewAhead randomView(common::RandomStream& random) {
  ViewAhead view{random.uniform(0.8, std::numbers::pi), std::nullopt, 0.275};
  if (random.chance(0.5)) view.camera_half_field_rad = random.uniform(0.3, 1.0);
  return view;
}

RC_GTEST_PROP(YawPlanner, NoSequenceOfChoicesIsCheaper, (std::uint64_t seed)) {
  common::RandomStream random(seed, "yaw brute force");
  const YawTask task = randomTask(random);
  const YawPlanner planner(randomView(random));
  // A path with a corner, of four places: 38 x 38 x 38 sequences.
  YawTask probe = task;
  const double stretch_m = YawPlanner::placesAlong({{0, 0}, {9, 0}}, probe)[0].length_m;
  const double turn_rad = random.uniform(-3.0, 3.0);
  const Point corner(1.4 * stretch_m, 0.0);
  const std::vector<Point> path{{0, 0}, corner, corner + stretch_m * Point(std::cos(turn_rad), std::sin(turn_rad))};
  const auto places = YawPlanner::placesAlong(path, task);
  RC_ASSERT(places.size() <= 4U);
  const std::vector<Facing> facings = planner.plan(path, task);
  std::vector<double> yaws_rad;
  for (const Facing& facing : facings) yaws_rad.push_back(facing.yaw_rad);
  RC_ASSERT(std::abs(cost_s(planner, places, yaws_rad, task) - leastCost_s(planner, places, 0, task.yaw_rad, task)) <
            1e-6);
}

RC_GTEST_PROP(YawPlanner, KeepsTheYawRateAndTheEnds, (std::uint64_t seed)) {
  common::RandomStream random(seed, "yaw laws");
  const YawTask task = randomTask(random);
  const YawPlanner planner(randomView(random));
  std::vector<Point> path{{0, 0}};
  for (int i = 0; i < 6; ++i) path.push_back(path.back() + Point(random.gaussian(1.0), random.gaussian(1.0)));
  const std::vector<Facing> facings = planner.plan(path, task);
  RC_ASSERT(facings.front().place_m == path.front());
  RC_ASSERT((facings.back().place_m - path.back()).norm() < 1e-9);
  RC_ASSERT(std::abs(common::wrapAngle(facings.front().yaw_rad - task.yaw_rad)) < 1e-9);
  if (task.goal_yaw_rad) RC_ASSERT(std::abs(common::wrapAngle(facings.back().yaw_rad - *task.goal_yaw_rad)) < 1e-9);
  const auto places = YawPlanner::placesAlong(path, task);
  for (std::size_t i = 0; i + 1 < facings.size(); ++i) {
    const auto step = planner.step(places[i], facings[i].yaw_rad, facings[i + 1].yaw_rad, task);
    const double turn_rad = std::abs(common::wrapAngle(facings[i + 1].yaw_rad - facings[i].yaw_rad));
    RC_ASSERT(turn_rad <= step.time_s * task.yaw_rate_rad_s + 1e-9);
    const bool blind = planner.fliesBlind(facings[i].yaw_rad - places[i].course_rad) ||
                       planner.fliesBlind(facings[i + 1].yaw_rad - places[i].course_rad);
    RC_ASSERT((facings[i].speed_m_s < 0.2) == blind);
  }
  const std::vector<Facing> again = planner.plan(path, task);
  for (std::size_t i = 0; i < facings.size(); ++i) {
    RC_ASSERT(again[i].yaw_rad == facings[i].yaw_rad);
    RC_ASSERT(again[i].speed_m_s == facings[i].speed_m_s);
  }
}

// What one does.

TEST(YawPlanner, AShortMoveIsFlownBackwardsWithoutATurn) {
  for (const ViewAhead& view : {kLaser, kLaserAndCamera, kAllRound}) {
    const auto facings = YawPlanner(view).plan({{0, 0}, {-0.1, 0}}, kTask);
    ASSERT_FALSE(facings.empty());
    EXPECT_LT(turned_rad(facings), 1e-9) << "10 cm backwards (Grzonka 2012, section IV-E)";
  }
}

TEST(YawPlanner, ALongPathBehindTheVehicleIsFacedFirst) {
  const auto facings = YawPlanner(kLaser).plan({{0, 0}, {-5, 0}}, kTask);
  const YawPlanner planner(kLaser);
  double blind_m = 0.0;
  for (std::size_t i = 0; i + 1 < facings.size(); ++i) {
    if (planner.fliesBlind(offCourse_rad(facings, i))) blind_m += (facings[i + 1].place_m - facings[i].place_m).norm();
  }
  EXPECT_LT(blind_m, 0.4) << "before its laser sees where it flies";
  EXPECT_LT(facings.front().speed_m_s, 0.16) << "until it sees where it flies";
  EXPECT_GT(greatestTurn_rad(facings), 60.0 * kDeg) << "it turns before it flies";
  EXPECT_LT(offCourse_rad(facings, facings.size() / 2), 25.0 * kDeg);
}

TEST(YawPlanner, WhoSeesAllRoundNeverWaitsForItsNose) {
  common::RandomStream random(5, "all round");
  for (int n = 0; n < 50; ++n) {
    YawTask task = kTask;
    task.yaw_rad = random.uniform(-3.1, 3.1);
    const auto facings = YawPlanner(kAllRound).plan({{0, 0}, {random.uniform(-4, 4), 3}, {5, 5}}, task);
    for (const Facing& facing : facings) EXPECT_GT(facing.speed_m_s, 100.0);
    EXPECT_LT(greatestTurn_rad(facings), 31.0 * kDeg) << "at the start, where it is slow anyway";
  }
}

TEST(YawPlanner, ACameraIsTurnedToWhereItFliesWhereALaserIsNot) {
  const std::vector<Point> aside{{0, 0}, {0, 2}};
  EXPECT_LT(turned_rad(YawPlanner(kLaser).plan(aside, kTask)), 65.0 * kDeg);
  EXPECT_GT(turned_rad(YawPlanner(kLaserAndCamera).plan(aside, kTask)), 75.0 * kDeg);
}

TEST(YawPlanner, TheNoseIsWhereTheGoalWantsItWithoutAWaitOnALongPath) {
  YawTask task = kTask;
  task.goal_yaw_rad = 90.0 * kDeg;
  const auto facings = YawPlanner(kLaser).plan({{0, 0}, {6, 0}}, task);
  EXPECT_NEAR(facings.back().yaw_rad, 90.0 * kDeg, 1e-9);
  EXPECT_LT(greatestTurn_rad(facings), 31.0 * kDeg);
  EXPECT_LT(offCourse_rad(facings, facings.size() / 2), 1.0 * kDeg) << "not before it needs to";
}

TEST(YawPlanner, ViewCostsGrowFromTheNoseToTheBack) {
  for (const ViewAhead& view : {kLaser, kLaserAndCamera}) {
    const YawPlanner planner(view);
    EXPECT_LT(planner.viewCost_s_m(0.0), 1e-3);
    for (int degree = 1; degree <= 180; ++degree)
      EXPECT_GE(planner.viewCost_s_m(degree * kDeg), planner.viewCost_s_m((degree - 1) * kDeg) - 1e-9);
  }
  EXPECT_GT(YawPlanner(kLaserAndCamera).viewCost_s_m(60 * kDeg), YawPlanner(kLaser).viewCost_s_m(60 * kDeg) + 0.1);
}

TEST(YawPlanner, APathThatGoesNowhereHasNoFacings) {
  EXPECT_TRUE(YawPlanner(kLaser).plan({}, kTask).empty());
  EXPECT_TRUE(YawPlanner(kLaser).plan({{1, 1}}, kTask).empty());
  EXPECT_TRUE(YawPlanner(kLaser).plan({{1, 1}, {1, 1}}, kTask).empty()) << "only the height changes";
}

}  // namespace
}  // namespace swiftlet::planning
