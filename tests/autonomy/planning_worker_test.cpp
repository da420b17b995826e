// Answers of the planning job: paths to goals, to nearly free goals, and to places where others can pass.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "autonomy/planning_jobs/planning_worker.hpp"
#include "planning/search/planner_choice.hpp"

namespace swiftlet::autonomy {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A room of 8 m by 4 m from the origin on, walls included.
std::shared_ptr<common::OccupancyGrid> room() {
  auto grid = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 160; ++x) {
      const bool wall = x == 0 || y == 0 || x == 159 || y == 79;
      grid->set({x, y}, wall ? common::occupancy::kMaxSteps : -common::occupancy::kMaxSteps);
    }
  return grid;
}

struct Worker : testing::Test {
  PlanningAnswer ask(decltype(PlanningRequest::question) question, std::vector<common::Disc> discs = {}) {
    PlanningRequest request;
    request.discs = std::move(discs);
    request.people = people;
    request.grid = std::make_shared<const common::OccupancyGrid>(grid->snapshot());
    request.footprint = {0.275, 0.10};
    request.T_map_body = pose;
    request.question = std::move(question);
    return worker.answer(request);
  }
  /// Looks from viewpoint to viewpoint of a map that stays as it is, until there is none.
  PlanningAnswer explore(const std::vector<common::Disc>& discs = {}) {
    constexpr int kMostLooks = 20;
    for (int looks = 0;; ++looks) {
      PlanningAnswer answer = ask(ExploreRequest{std::nullopt, attempts, std::nullopt}, discs);
      if (looks == kMostLooks || !answer.exploration->next) return answer;
      attempts.push_back(planning::attemptFrom(*answer.exploration->next));
    }
  }
  /// A wall at x = 4 m with a door of `door_cells` cells around y = 2 m.
  void build(int door_cells) {
    for (int y = 0; y < 80; ++y)
      if (y < 40 - door_cells / 2 || y >= 40 - door_cells / 2 + door_cells)
        grid->set({80, y}, common::occupancy::kMaxSteps);
  }
  common::Pose2 pose{2.0, 2.0, 0.0};
  std::vector<common::DynamicObstacle> people;
  std::vector<planning::ExplorationAttempt> attempts;
  std::shared_ptr<common::OccupancyGrid> grid = room();
  PlanningWorker worker{PlanningConfig{}, 0.05};
};

TEST_F(Worker, FindsThePathToAGoal) {
  const auto answer = ask(GoalRequest{{6.0, 2.0}, 0.05});
  ASSERT_TRUE(answer.path && *answer.path);
  EXPECT_EQ((*answer.path)->points_map_m.back(), Eigen::Vector2d(6.0, 2.0));
}

TEST_F(Worker, TheChosenPlannerFindsThePathAndIsCounted) {
  build(24);
  EXPECT_EQ(ask({}).use.paths, 0);
  const auto first = ask(GoalRequest{{6.0, 3.0}, 0.05});
  EXPECT_EQ(first.use.planner, "D* Lite");
  EXPECT_EQ(first.use.paths, 1);
  PlanningConfig by_wavefront;
  by_wavefront.planner.kind = planning::PlannerKind::kWavefront;
  worker = PlanningWorker{by_wavefront, 0.05};
  const auto second = ask(GoalRequest{{6.0, 3.0}, 0.05});
  EXPECT_EQ(second.use.planner, "wavefront");
  EXPECT_EQ(second.use.paths, 1);
  ASSERT_TRUE(*first.path && *second.path);
  EXPECT_NEAR((*first.path)->cost_m, (*second.path)->cost_m, 0.05) << "both are optimal on the cells";
  EXPECT_EQ(ask(GoalRequest{{90.0, 3.0}, 0.05}).use.paths, 1) << "a path that was not found is none";
}

TEST_F(Worker, TheChosenPlannerFindsThePathToTheViewpoint) {
  for (int y = 20; y < 50; ++y) grid->set({159, y}, -common::occupancy::kMaxSteps);
  for (const planning::PlannerKind kind : {planning::PlannerKind::kDStarLite, planning::PlannerKind::kWavefront}) {
    PlanningConfig config;
    config.planner.kind = kind;
    worker = PlanningWorker{config, 0.05};
    const auto answer = ask(ExploreRequest{});
    ASSERT_TRUE(answer.exploration && answer.exploration->next && answer.path && *answer.path);
    EXPECT_EQ((*answer.path)->points_map_m.front(), pose.position_m());
    EXPECT_EQ((*answer.path)->points_map_m.back(), answer.exploration->next->pose_map.position_m());
    EXPECT_EQ(answer.use.explorer, "utility");
    EXPECT_EQ(answer.use.planner, planning::makePlanner({kind})->name());
    EXPECT_EQ(answer.use.paths, 1);
    EXPECT_EQ(answer.use.viewpoints, 1);
    const auto again = ask(ExploreRequest{answer.exploration->next, {}, std::nullopt});
    EXPECT_TRUE(again.exploration->kept_current);
    EXPECT_EQ(again.use.paths, 2);
    EXPECT_EQ(again.use.viewpoints, 1) << "the same is flown to";
  }
}

TEST_F(Worker, ReachesAGoalTooCloseToTheWallWithinItsTolerance) {
  const Eigen::Vector2d goal(6.0, 0.38);  // The wall ends at 0.05 m; hull and clearance are 0.375 m.
  const auto strict = ask(GoalRequest{goal, 0.0});
  ASSERT_TRUE(strict.path && !*strict.path);
  EXPECT_EQ(strict.path->error().reason, planning::PlanFailure::Reason::kGoalBlocked);
  const auto tolerant = ask(GoalRequest{goal, 0.15});
  ASSERT_TRUE(tolerant.path && *tolerant.path);
  EXPECT_LT(((*tolerant.path)->points_map_m.back() - goal).norm(), 0.8 * 0.15);
  EXPECT_FALSE(ask(GoalRequest{{6.0, 0.1}, 0.15}).path->has_value());
}

TEST_F(Worker, AFlownDoorStaysPassableWhenItsFrameGrowsSlightly) {
  build(16);
  for (; pose.x_m < 6.0; pose.x_m += 0.2) {
    const auto answer = ask(GoalRequest{{6.0, 2.0}, 0.05});
    ASSERT_TRUE(answer.path && *answer.path);
  }
  build(14);  // The door frame has grown by a cell on each side.
  const auto back = ask(GoalRequest{{2.0, 2.0}, 0.05});
  ASSERT_TRUE(back.path && *back.path);
  worker = PlanningWorker{PlanningConfig{}, 0.05};
  EXPECT_FALSE(ask(GoalRequest{{2.0, 2.0}, 0.05}).path->has_value())
      << "a worker that has not flown through the door finds it too narrow";
}

TEST_F(Worker, ANewObstacleBlocksAFlownPath) {
  for (; pose.x_m < 6.0; pose.x_m += 0.2) (void)ask(GoalRequest{{6.0, 2.0}, 0.05});
  build(11);  // An obstacle was added: less than half the clearance is left.
  EXPECT_FALSE(ask(GoalRequest{{2.0, 2.0}, 0.05}).path->has_value());
}

TEST_F(Worker, MakesRoomForAPersonInTheDoor) {
  build(20);
  const Eigen::Vector2d door(4.0, 2.0);
  pose.x_m = 3.0;
  const auto answer = ask(DetourRequest{{6.0, 2.0}, door}, {{door, 0.5}});
  ASSERT_TRUE(answer.detour);
  EXPECT_TRUE(answer.detour->makes_room);
  EXPECT_GT((answer.detour->path.points_map_m.back() - door).norm(), 1.5);
}

/// The west wall has an opening to the outside, where nothing is to be matched, and much more room.
TEST_F(Worker, MakesRoomWhereThePositionIsKnown) {
  build(20);
  for (int y = -150; y < 230; ++y)
    for (int x = -300; x < 0; ++x) grid->set({x, y}, -common::occupancy::kMaxSteps);
  for (int y = 25; y < 55; ++y) grid->set({0, y}, -common::occupancy::kMaxSteps);
  const auto answer = ask(DetourRequest{{6.0, 2.0}, Eigen::Vector2d(4.0, 2.0)}, {{{4.0, 2.0}, 0.5}});
  ASSERT_TRUE(answer.detour);
  EXPECT_TRUE(answer.detour->makes_room);
  EXPECT_GT(answer.detour->path.points_map_m.back().x(), 0.0);
}

/// From the far end of a corridor, which is wider, the height of a beam at the blockage is not known.
TEST_F(Worker, LooksFromAFewMetresAndNotFromTheWidestPlace) {
  grid = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
  for (int y = -60; y <= 60; ++y)
    for (int x = -100; x <= 320; ++x) {
      const bool open = std::abs(y) < (x < 260 ? 16 : 60) && x > -100 && x < 320;
      grid->set({x, y}, (open ? -1 : 1) * common::occupancy::kMaxSteps);
    }
  pose = {1.5, 0.0, 0.0};
  const auto answer = ask(DetourRequest{{-4.0, 0.0}, Eigen::Vector2d(0.0, 0.0)}, {{{0.0, 0.0}, 0.6}});
  ASSERT_TRUE(answer.detour);
  EXPECT_NEAR(answer.detour->path.points_map_m.back().x(), 3.0, 0.3);
  pose.x_m = 3.4;
  EXPECT_FALSE(ask(DetourRequest{{-4.0, 0.0}, Eigen::Vector2d(0.0, 0.0), true}, {{{0.0, 0.0}, 0.6}}).detour)
      << "not worth a flight";
  pose.x_m = 10.0;
  EXPECT_TRUE(ask(DetourRequest{{-4.0, 0.0}, Eigen::Vector2d(0.0, 0.0), true}, {{{0.0, 0.0}, 0.6}}).detour);
}

TEST_F(Worker, FliesToSeeWhetherTheDoorIsStillBlocked) {
  build(0);
  for (int y = 30; y <= 50; ++y) grid->set({80, y}, -common::occupancy::kMaxSteps);
  grid->set({80, 40}, common::occupancy::kMaxSteps);  // A door of 1 m at y = 2 m with something in its middle.
  pose.y_m = 3.2;
  const auto answer = ask(DetourRequest{{6.0, 3.2}});
  ASSERT_TRUE(answer.detour);
  EXPECT_FALSE(answer.detour->makes_room);
  EXPECT_LT((answer.detour->path.points_map_m.back() - Eigen::Vector2d(4.0, 2.0)).norm(), 0.8);
}

TEST_F(Worker, ApproachesABlockedGoalAndThenMakesRoom) {
  const Eigen::Vector2d goal(6.0, 2.0);
  for (int y = 35; y <= 45; ++y)
    for (int x = 115; x <= 125; ++x) grid->set({x, y}, common::occupancy::kMaxSteps);
  ASSERT_FALSE(ask(GoalRequest{goal, 0.05}).path->has_value());
  const auto answer = ask(DetourRequest{goal});
  ASSERT_TRUE(answer.detour);
  EXPECT_FALSE(answer.detour->makes_room);
  const Eigen::Vector2d place = answer.detour->path.points_map_m.back();
  EXPECT_NEAR((place - goal).norm(), 0.275 + 0.275 + 0.1, 0.1);
  pose.x_m = place.x();
  pose.y_m = place.y();
  const auto next = ask(DetourRequest{goal});
  ASSERT_TRUE(next.detour);
  EXPECT_TRUE(next.detour->makes_room);
}

std::vector<common::Frontier> blockedFrontiers(const PlanningAnswer& answer) {
  std::vector<common::Frontier> frontiers = answer.exploration->frontiers;
  std::erase_if(frontiers, [](const auto& one) { return one.reason != common::FrontierReason::kBlocked; });
  return frontiers;
}

/// Draws the outline of somebody who stands there, unknown inside.
void stand(common::OccupancyGrid& grid, const Eigen::Vector2d& place_m) {
  for (double x_m = -0.3; x_m <= 0.3; x_m += 0.02)
    for (double y_m = -0.3; y_m <= 0.3; y_m += 0.02) {
      const double off_m = std::hypot(x_m, y_m);
      if (off_m > 0.25) continue;
      grid.set(grid.cellAt(place_m + Eigen::Vector2d(x_m, y_m)),
               off_m > 0.2 ? common::occupancy::kMaxSteps : common::occupancy::kUnknown);
    }
}

/// The wall is thinner than a person, so that a path through it would meet fewer occupied cells.
TEST_F(Worker, NamesThePersonInTheDoorAndNotTheThinWall) {
  build(20);
  const Eigen::Vector2d door(4.0, 2.0);
  common::DynamicObstacle person{7, door, 0.25, {0.3, 0.0}, true, {}};
  people = {person};
  EXPECT_TRUE(ask(GoalRequest{{6.0, 2.0}, 0.05}).path->has_value());
  stand(*grid, door);
  people.clear();  // Who stands still is part of the map, and not tracked any more.
  const auto answer = ask(GoalRequest{{6.0, 2.0}, 0.05});
  ASSERT_FALSE(answer.path->has_value());
  ASSERT_TRUE(answer.blockage);
  EXPECT_EQ(answer.blockage->who, "a person at (4.00, 2.00)");
  EXPECT_FALSE(answer.opened);
  EXPECT_FALSE(ask({}).opened) << "nothing has changed";
  grid = room();
  build(20);
  EXPECT_TRUE(ask({}).opened);
  EXPECT_TRUE(ask(GoalRequest{{6.0, 2.0}, 0.05}).path->has_value());
}

TEST_F(Worker, AWalledGoalIsNotBlockedForNow) {
  build(0);
  const auto answer = ask(GoalRequest{{6.0, 2.0}, 0.05});
  ASSERT_FALSE(answer.path->has_value());
  EXPECT_FALSE(answer.blockage);
}

/// A door that it flew through has closed behind it.
TEST_F(Worker, WhatStandsWhereItFlewCameLater) {
  build(20);
  for (; pose.x_m < 6.0; pose.x_m += 0.1) (void)ask({});
  build(0);
  const auto answer = ask(GoalRequest{{2.0, 2.0}, 0.05});
  ASSERT_FALSE(answer.path->has_value());
  ASSERT_TRUE(answer.blockage);
  EXPECT_TRUE(answer.blockage->who.starts_with("something that was not there before at")) << answer.blockage->who;
}

/// Somebody who stood in the only door before the vehicle came, and was never seen to move.
TEST_F(Worker, AnExplorationIsIncompleteBehindSomebodyInTheDoor) {
  for (int y = 0; y < 80; ++y)
    for (int x = 81; x < 160; ++x) grid->set({x, y}, common::occupancy::kUnknown);
  build(20);
  stand(*grid, {4.0, 2.0});
  for (double side_m : {-0.4, 0.4})  // Seen past him.
    for (double x_m = 4.0; x_m < 6.5; x_m += 0.02) grid->set(grid->cellAt(x_m, 2.0 + side_m), -100);
  auto answer = explore();
  ASSERT_TRUE(answer.exploration->done);
  ASSERT_TRUE(answer.blockage);
  EXPECT_TRUE(answer.blockage->who.starts_with("something as wide as a person at (4.0")) << answer.blockage->who;
  EXPECT_GE(answer.blockage->frontiers, 1);
  EXPECT_EQ(blockedFrontiers(answer).size(), static_cast<std::size_t>(answer.blockage->frontiers));

  // Swaying, they are drawn in pieces, each of which could be anything.
  for (int y = 36; y < 45; ++y)
    for (int x = 76; x < 85; ++x)
      if (common::occupancy::isOccupied(grid->at({x, y})) && (x + y) % 3 != 0) grid->set({x, y}, -100);
  grid->set(grid->cellAt(4.0, 1.9), common::occupancy::kMaxSteps);
  grid->set(grid->cellAt(4.0, 2.1), common::occupancy::kMaxSteps);
  answer = explore();
  ASSERT_TRUE(answer.exploration->done);
  ASSERT_TRUE(answer.blockage) << "nobody has gone";
  EXPECT_TRUE(answer.blockage->who.starts_with("something as wide as a person at ")) << answer.blockage->who;
}

/// Seen from one side only, in a door whose far side nobody has seen, the outline is as narrow as a piece of a wall.
TEST_F(Worker, TheNearSideOfSomebodyInTheDoorIsWaitedFor) {
  for (int y = 0; y < 80; ++y)
    for (int x = 81; x < 160; ++x) grid->set({x, y}, common::occupancy::kUnknown);
  build(20);
  const Eigen::Vector2d person(4.0, 2.1), from(2.0, 1.0);
  for (int y = 30; y < 50; ++y) grid->set({80, y}, common::occupancy::kUnknown);
  for (double x_m = -0.3; x_m <= 0.3; x_m += 0.02)
    for (double y_m = -0.3; y_m <= 0.3; y_m += 0.02) {
      const Eigen::Vector2d off_m(x_m, y_m);
      if (off_m.norm() > 0.25 || off_m.norm() < 0.2 || off_m.dot(from - person) < 0.0) continue;
      grid->set(grid->cellAt(person + off_m), common::occupancy::kMaxSteps);
    }
  auto answer = explore();
  ASSERT_TRUE(answer.exploration->done);
  ASSERT_TRUE(answer.blockage);
  EXPECT_TRUE(answer.blockage->who.starts_with("something as wide as a person at ")) << answer.blockage->who;
}

/// A piece of a wall as wide as a person, beside which nothing was seen, is no one who may go.
TEST_F(Worker, APieceOfAWallIsNotWaitedFor) {
  for (int y = 0; y < 80; ++y)
    for (int x = 80; x < 160; ++x) grid->set({x, y}, common::occupancy::kUnknown);
  build(0);
  for (int y : {33, 34, 44, 45}) grid->set({80, y}, common::occupancy::kUnknown);
  auto answer = explore();
  ASSERT_TRUE(answer.exploration->done);
  EXPECT_FALSE(answer.blockage) << answer.blockage->who;
}

/// Two doors in the wall, and a person in each; the west wall has a crack.
TEST_F(Worker, BlockedFrontiersAreToldFromWalledOnesEachWithWhoIsInTheWay) {
  for (int y = 0; y < 80; ++y)
    for (int x = 81; x < 160; ++x) grid->set({x, y}, common::occupancy::kUnknown);
  for (int y = 0; y < 80; ++y)
    if (std::abs(y - 20) >= 10 && std::abs(y - 60) >= 10) grid->set({80, y}, common::occupancy::kMaxSteps);
  for (int y = 37; y < 44; ++y) grid->set({0, y}, -common::occupancy::kMaxSteps);
  people = {{1, {4.0, 1.0}, 0.25, {0.3, 0.0}, true, {}}, {2, {4.0, 3.0}, 0.25, {0.3, 0.0}, true, {}}};
  std::vector<common::Disc> discs;
  for (const common::DynamicObstacle& person : people) discs.push_back({person.center_map_m, 0.6});
  auto answer = explore(discs);
  ASSERT_TRUE(answer.blockage);
  EXPECT_EQ(blockedFrontiers(answer).size(), static_cast<std::size_t>(answer.blockage->frontiers));
  EXPECT_THAT(answer.blockage->who, AllOf(HasSubstr("a person at (4.00, 1.00)"), HasSubstr(" and a person at ")));
  std::vector<std::string> explanations;
  for (const common::Frontier& frontier : blockedFrontiers(answer)) {
    const char* own = frontier.centroid_map_m.y() < 2.0 ? "(4.00, 1.00)" : "(4.00, 3.00)";
    EXPECT_EQ(frontier.explanation, fmt::format("blocked: a person at {} is in the way", own));
  }
  const auto& frontiers = answer.exploration->frontiers;
  EXPECT_TRUE(std::any_of(frontiers.begin(), frontiers.end(), [](const common::Frontier& frontier) {
    return frontier.centroid_map_m.x() < 0.1 && frontier.reason != common::FrontierReason::kBlocked;
  })) << "nobody stands in the crack";
}

/// A room around the take-off place and another one; the door between them is at (2, 0).
struct WorkerAwayFromHome : Worker {
  WorkerAwayFromHome() {
    grid = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
    for (int y = -40; y <= 40; ++y)
      for (int x = -40; x <= 120; ++x) {
        const bool wall = x == -40 || y == -40 || x == 120 || y == 40 || (x == 40 && std::abs(y) > 12);
        grid->set({x, y}, wall ? common::occupancy::kMaxSteps : -common::occupancy::kMaxSteps);
      }
    pose = {4.0, 0.0, 0.0};
  }
};

TEST_F(WorkerAwayFromHome, SomebodyInTheDoorBlocksThePathHomeOnlyForAWhile) {
  EXPECT_NEAR(ask({}).home_m.value(), 4.0, 0.1);
  const common::Disc in_the_door{{2.0, 0.0}, 0.5};
  std::optional<double> home_m;
  for (int i = 0; i < 70; ++i) home_m = ask({}, {in_the_door}).home_m;
  EXPECT_NEAR(home_m.value(), 4.0, 0.1);
  pose.x_m = 5.0;
  for (int i = 0; i < 8; ++i) home_m = ask({}, {in_the_door}).home_m;
  EXPECT_NEAR(home_m.value(), 5.0, 0.1) << "and what has been flown since";
  for (int i = 0; i < 80; ++i) home_m = ask({}, {in_the_door}).home_m;
  EXPECT_FALSE(home_m);
}

TEST_F(WorkerAwayFromHome, ATakeOffPlaceThatIsNoLongerFreeIsReachedNearby) {
  grid->set({0, 0}, common::occupancy::kMaxSteps);
  const auto home_m = ask({}).home_m;
  ASSERT_TRUE(home_m);
  EXPECT_NEAR(*home_m, 4.0, 1.0);
}

}  // namespace
}  // namespace swiftlet::autonomy
