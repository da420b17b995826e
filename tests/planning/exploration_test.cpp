// Exploration of flat worlds by an ideal vehicle: it always ends, every reachable place is explored, and every
// remaining frontier has its reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "flatland.hpp"
#include "grid_builder.hpp"
#include "planning/costs/localizability.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/exploration/frontiers.hpp"

namespace swiftlet::planning {
namespace {

using common::FrontierReason;
using testing::HasSubstr;

void expectExplored(const test::FlightReport& report, const std::string& name) {
  EXPECT_TRUE(report.done) << name << ": " << report.last.reason;
  EXPECT_GE(report.coverage, 0.99) << name;
  EXPECT_FALSE(report.touched) << name;
  for (const common::Frontier& frontier : report.last.frontiers) {
    EXPECT_NE(frontier.reason, FrontierReason::kOpen) << name;
    EXPECT_FALSE(frontier.explanation.empty()) << name;
  }
}

/// Writes the figures of a flight into the test's record.
void record(const test::FlightReport& r, const std::string& name) {
  testing::Test::RecordProperty(name, fmt::format("{:.1f} s {:.1f} m coverage {:.4f} {} calls {} frontiers left",
                                                  r.time_s, r.length_m, r.coverage, r.calls, r.last.frontiers.size()));
}

test::FlightConfig quick() {
  test::FlightConfig config;
  config.beams = 361;
  return config;
}

int countOf(const ExplorationResult& result, FrontierReason reason) {
  return static_cast<int>(std::count_if(result.frontiers.begin(), result.frontiers.end(),
                                        [&](const common::Frontier& f) { return f.reason == reason; }));
}

TEST(Exploration, PocketsBehindBoxesAreExplored) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::string name = fmt::format("pocket_{}", seed);
    const test::FlightReport report = test::fly(test::pocketRoom(seed), quick(), seed);
    record(report, name);
    expectExplored(report, name);
    EXPECT_LT(report.time_s, 60.0) << name;
  }
}

TEST(Exploration, RandomBuildingsAreExplored) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::string name = fmt::format("building_{}", seed);
    const test::FlightReport report = test::fly(test::randomBuilding(seed, 14, 10, 3, 2, 8), quick(), seed);
    record(report, name);
    expectExplored(report, name);
  }
}

TEST(Exploration, TheNearestFrontierAndTheTourExploreBuildingsToo) {
  test::FlightConfig config = quick();
  for (const int i : {0, 1, 2, 3}) {
    const bool pockets = i % 2 == 0;
    config.explorer.kind = i < 2 ? ExplorerKind::kNearestFrontier : ExplorerKind::kTour;
    const std::string name = fmt::format("{}_{}", i < 2 ? "nearest" : "tour", pockets ? "pocket" : "building");
    const auto world = pockets ? test::pocketRoom(1) : test::randomBuilding(1, 14, 10, 3, 2, 8);
    const test::FlightReport report = test::fly(world, config, 1);
    record(report, name);
    expectExplored(report, name);
  }
}

/// Beside the vehicle a nook of half a metre, across the hall an unknown room.
TEST(NearestFrontier, IsChosenWhateverItsSizeAndKeptUntilReached) {
  common::OccupancyGrid grid = test::room(200, 100);
  test::fill(grid, {{30, 100}, {50, 101}}, test::kFreeCell);
  test::fill(grid, {{25, 102}, {55, 103}}, test::kWallCell);
  test::fill(grid, {{200, 30}, {201, 70}}, test::kFreeCell);
  auto map = std::make_shared<CostMap>(CostMap::Config{}, 0.05);
  map->update(grid.snapshot(), {});
  ExplorationInput input{map, {2.0, 2.5, 0.0}, std::nullopt, {}, std::nullopt};
  const auto first = exploreNearestFrontier(input, {}).next, by_gain = exploreByUtility(input, {}).next;
  ASSERT_TRUE(first && by_gain);
  EXPECT_NEAR(first->target_map_m.x(), 2.0, 0.6);
  EXPECT_GT(by_gain->target_map_m.x(), 9.0);
  EXPECT_LT((first->target_map_m - first->pose_map.position_m()).norm(), 0.6) << "it goes there to look";
  const Eigen::Vector2d to = first->target_map_m - first->pose_map.position_m();
  EXPECT_NEAR(common::wrapAngle(std::atan2(to.y(), to.x()) - first->pose_map.yaw_rad), 0.0, 1e-9);

  input.current = first;
  input.pose_map = {8.5, 2.5, 0.0};
  const ExplorationResult later = exploreNearestFrontier(input, {});
  EXPECT_TRUE(later.kept_current) << "though the other is nearer now";
  EXPECT_EQ(later.next->pose_map.position_m(), first->pose_map.position_m());
  input.attempts.assign(3, attemptFrom(*first));
  const ExplorationResult last = exploreNearestFrontier(input, {});
  EXPECT_FALSE(last.kept_current);
  ASSERT_TRUE(last.next);
  EXPECT_GT(last.next->target_map_m.x(), 9.0);
}

/// A hall with a nook of half a metre above its left end, and an unknown room behind its right end.
struct TourOfTwo : testing::Test {
  TourOfTwo() {
    common::OccupancyGrid grid = test::room(200, 100);
    test::fill(grid, {{30, 100}, {50, 101}}, test::kFreeCell);
    test::fill(grid, {{25, 102}, {55, 103}}, test::kWallCell);
    test::fill(grid, {{200, 30}, {201, 70}}, test::kFreeCell);
    auto map = std::make_shared<CostMap>(CostMap::Config{}, 0.05);
    map->update(grid.snapshot(), {});
    input.cost_map = map;
  }
  double firstX(double x_m, std::optional<double> home_x_m) {
    input.pose_map = {x_m, 2.5, 0.0};
    input.home_map_m = home_x_m ? std::optional(Eigen::Vector2d(*home_x_m, 2.5)) : std::nullopt;
    const ExplorationResult result = exploreByTour(input, near_sighted);
    EXPECT_TRUE(result.next) << result.reason;
    return result.next ? result.next->target_map_m.x() : -1.0;
  }
  ExplorationInput input;
  ExplorerConfig near_sighted{.laser_range_m = 3.0};  ///< So that neither is seen from far away.
};

TEST_F(TourOfTwo, TakesWhatIsNearAlongInsteadOfComingBackForIt) {
  EXPECT_LT(firstX(2.0, std::nullopt), 3.0) << "though the room promises more";
  EXPECT_GT(firstX(8.0, std::nullopt), 9.0);
}

TEST_F(TourOfTwo, EndsNearHome) {
  EXPECT_GT(firstX(5.5, 1.0), 9.0);
  EXPECT_LT(firstX(5.5, 9.0), 3.0);
}

TEST_F(TourOfTwo, LooksFromNearSoThatNothingIsLeftToReturnFor) {
  input.pose_map = {8.0, 2.5, 0.0};
  const auto distance_m = [](const ExplorationResult& result) {
    return (result.next->pose_map.position_m() - result.next->target_map_m).norm();
  };
  const ExplorationResult tour = exploreByTour(input, near_sighted), utility = exploreByUtility(input, near_sighted);
  ASSERT_TRUE(tour.next && utility.next);
  EXPECT_LT(distance_m(tour), 1.2);
  EXPECT_GT(distance_m(utility), 1.2) << "from here it sees a part of it sooner";
}

TEST_F(TourOfTwo, KeepsItsViewpointUnlessAnotherOrderIsMuchBetter) {
  input.pose_map = {5.5, 2.5, 0.0};
  input.home_map_m = Eigen::Vector2d(1.0, 2.5);
  input.current = exploreByTour(input, near_sighted).next;
  ASSERT_TRUE(input.current);
  EXPECT_TRUE(exploreByTour(input, near_sighted).kept_current);
  // Home is elsewhere: the order to there is worth turning round.
  input.home_map_m = Eigen::Vector2d(9.0, 2.5);
  EXPECT_FALSE(exploreByTour(input, near_sighted).kept_current);
  // Most of what it promised was seen on the way.
  input.home_map_m = Eigen::Vector2d(1.0, 2.5);
  input.current->gain_m2 *= 10.0;
  EXPECT_FALSE(exploreByTour(input, near_sighted).kept_current);
}

TEST(Exploration, EndsBesideAWallThatReturnsNoBeams) {
  test::Flatland world = test::pocketRoom(3);
  world.black.push_back({{world.width - 2, 40}, {world.width, 90}});
  test::FlightConfig config = quick();
  config.limit_s = 300.0;
  const test::FlightReport report = test::fly(world, config, 3);
  record(report, "black_wall");
  EXPECT_TRUE(report.done) << report.last.reason;
  EXPECT_GE(countOf(report.last, FrontierReason::kBlacklisted) + countOf(report.last, FrontierReason::kUnreachable) +
                countOf(report.last, FrontierReason::kTooSmall),
            1);
  EXPECT_EQ(countOf(report.last, FrontierReason::kOpen), 0);
}

/// Two rooms side by side, the right one unknown behind a doorway of `door` cells.
struct TwoRooms : testing::Test {
  ExplorationResult look(int door, ExplorationInput input = {}, ExplorerConfig config = {}) {
    common::OccupancyGrid grid = test::room(100, 100);
    test::fill(grid, {{100, 50}, {101, 50 + door}}, test::kFreeCell);
    auto map = std::make_shared<CostMap>(CostMap::Config{}, 0.05);
    map->update(grid.snapshot(), {});
    input.cost_map = map;
    input.pose_map = {2.0, 2.5, 0.0};
    return exploreByUtility(input, config);
  }
};

TEST_F(TwoRooms, ADoorwayIsAnOpenFrontierWithAViewpoint) {
  const ExplorationResult result = look(24);
  ASSERT_EQ(result.frontiers.size(), 1u);
  EXPECT_EQ(result.frontiers[0].reason, FrontierReason::kOpen);
  EXPECT_FALSE(result.done);
  ASSERT_TRUE(result.next);
  EXPECT_GT(result.next->gain_m2, 1.0);
  // The target is within the field of view.
  const Eigen::Vector2d to = result.next->target_map_m - result.next->pose_map.position_m();
  EXPECT_LT(std::abs(common::wrapAngle(std::atan2(to.y(), to.x()) - result.next->pose_map.yaw_rad)),
            135.0 * M_PI / 180.0);
  EXPECT_NEAR(result.explored_area_m2, (100 * 100 + 24) * 0.0025, 1e-6);
}

TEST_F(TwoRooms, ACrackIsReportedAsTooSmall) {
  const ExplorationResult result = look(3);
  ASSERT_EQ(result.frontiers.size(), 1u);
  EXPECT_EQ(result.frontiers[0].reason, FrontierReason::kTooSmall);
  EXPECT_EQ(result.frontiers[0].explanation, "too small: 0.15 m long");
  EXPECT_TRUE(result.done);
  EXPECT_FALSE(result.next);
}

TEST_F(TwoRooms, AFrontierBeyondTheBoundsIsReportedAsOutOfBounds) {
  ExplorationInput input;
  input.bounds = common::MapBounds{{0, 0}, {4.5, 5}, {}};
  EXPECT_EQ(look(24, input).frontiers[0].reason, FrontierReason::kOutOfBounds);
}

TEST_F(TwoRooms, NobodyLooksFromOutsideTheBounds) {
  const ExplorationResult free = look(24);
  ASSERT_TRUE(free.next);
  ExplorationInput input;
  input.bounds = common::MapBounds{{free.next->pose_map.x_m + 0.2, 0}, {6, 5}, {}};
  const ExplorationResult bounded = look(24, input);
  ASSERT_TRUE(bounded.next);
  EXPECT_TRUE(input.bounds->contains(bounded.next->pose_map.position_m())) << bounded.next->pose_map.x_m;
}

TEST(MapBounds, MayLieInAGivenMap) {
  const common::MapBounds bounds{{0, 0}, {4, 2}, common::Pose2{10.0, 5.0, 0.5 * std::numbers::pi}};
  EXPECT_TRUE(bounds.contains({9.0, 8.0}));
  EXPECT_FALSE(bounds.contains({3.0, 1.0}));
  EXPECT_FALSE(bounds.contains({11.0, 8.0}));
}

TEST_F(TwoRooms, AFrontierIsBlacklistedAfterEnoughLooks) {
  ExplorationInput input;
  for (int i = 0; i < 3; ++i) {
    const ExplorationResult result = look(24, input);
    ASSERT_TRUE(result.next) << i;
    EXPECT_EQ(result.frontiers[0].attempts, i);
    for (const ExplorationAttempt& other : input.attempts)
      EXPECT_GT((result.next->pose_map.position_m() - other.place_map_m).norm(), 0.35) << "from elsewhere each time";
    input.attempts.push_back(attemptFrom(*result.next));
  }
  const ExplorationResult result = look(24, input);
  EXPECT_TRUE(result.done);
  EXPECT_EQ(result.frontiers[0].reason, FrontierReason::kBlacklisted);
  EXPECT_EQ(result.frontiers[0].explanation, "blacklisted: looked at 3 times");
}

TEST_F(TwoRooms, TheSameInputGivesTheSameAnswer) {
  const ExplorationResult a = look(24), b = look(24);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.next->pose_map.position_m(), b.next->pose_map.position_m());
  EXPECT_EQ(a.next->utility, b.next->utility);
}

TEST_F(TwoRooms, KeepsTheViewpointWhileItIsGoodEnough) {
  ExplorationInput input;
  input.current = look(24).next;
  const Eigen::Vector2d place = input.current->pose_map.position_m();
  input.current->target_map_m.y() += 0.1;
  const ExplorationResult again = look(24, input);
  EXPECT_TRUE(again.kept_current);
  EXPECT_NEAR((again.next->pose_map.position_m() - place).norm(), 0.0, 0.05);
  // A place with nothing new to see is given up.
  input.current->target_map_m = {1.0, 1.0};
  EXPECT_FALSE(look(24, input).kept_current);
}

TEST_F(TwoRooms, AFrontierDuringWhoseApproachThePositionBecameUncertainIsLeft) {
  ExplorationInput input;
  input.lost_map_m = {{4.0, 2.5}};
  const ExplorationResult result = look(24, input);
  EXPECT_TRUE(result.done);
  EXPECT_EQ(result.frontiers[0].reason, FrontierReason::kPositionUncertain);
  EXPECT_EQ(result.frontiers[0].explanation,
            "position uncertain: the position became, or would become, uncertain during the approach");
  input.lost_map_m = {{0.2, 2.5}};
  EXPECT_EQ(look(24, input).frontiers[0].reason, FrontierReason::kOpen) << "a place far from it";
}

/// A room with a doorway that leads outside, where 12 m of free ground were seen and no wall.
struct DoorToTheOutside : testing::Test {
  ExplorationResult look(bool leave_building) {
    common::OccupancyGrid grid = test::room(100, 100);
    test::fill(grid, {{100, 45}, {101, 65}}, test::kFreeCell);
    test::fill(grid, {{101, -200}, {340, 300}}, test::kFreeCell);
    auto map = std::make_shared<CostMap>(CostMap::Config{}, 0.05);
    map->update(grid.snapshot(), {});
    ExplorationInput input;
    input.cost_map = map;
    input.pose_map = {4.0, 2.7, 0.0};
    input.leave_building = leave_building;
    return exploreByUtility(input, {});
  }
};

TEST_F(DoorToTheOutside, IsNotLeftWhereNoWallTellsThePosition) {
  const ExplorationResult result = look(false);
  EXPECT_TRUE(result.done) << result.reason;
  EXPECT_EQ(countOf(result, FrontierReason::kPositionUncertain), static_cast<int>(result.frontiers.size()));
}

TEST_F(DoorToTheOutside, IsLeftIfTheMissionAllowsIt) {
  const ExplorationResult result = look(true);
  EXPECT_TRUE(result.next);
  EXPECT_EQ(countOf(result, FrontierReason::kPositionUncertain), 0);
}

TEST(Exploration, FrontiersBehindANarrowPassageAreUnreachable) {
  // A passage 0.4 m wide that turns up; the room to the left of its end shows from inside the passage alone.
  common::OccupancyGrid grid = test::room(100, 100);
  test::fill(grid, {{100, 47}, {119, 57}}, test::kWallCell);
  test::fill(grid, {{109, 57}, {119, 81}}, test::kWallCell);
  test::fill(grid, {{100, 48}, {118, 56}}, test::kFreeCell);
  test::fill(grid, {{110, 56}, {118, 80}}, test::kFreeCell);
  test::fill(grid, {{109, 70}, {110, 80}}, common::occupancy::kUnknown);
  auto map = std::make_shared<CostMap>(CostMap::Config{}, 0.05);
  map->update(grid.snapshot(), {});
  const ExplorationResult result = exploreByUtility({map, {2.0, 2.6, 0.0}, std::nullopt, {}, std::nullopt}, {});
  ASSERT_EQ(result.frontiers.size(), 1u);
  EXPECT_EQ(result.frontiers[0].reason, FrontierReason::kUnreachable);
  EXPECT_THAT(result.frontiers[0].explanation, HasSubstr("at clearance 0.10 m"));
  EXPECT_TRUE(result.done);
}

TEST(Exploration, ReportsAVehicleThatIsShutIn) {
  common::OccupancyGrid grid = test::room(40, 4);
  auto map = std::make_shared<CostMap>(CostMap::Config{}, 0.05);
  map->update(grid.snapshot(), {});
  for (const ExplorerKind kind : {ExplorerKind::kUtility, ExplorerKind::kNearestFrontier, ExplorerKind::kTour}) {
    const auto result = explore({map, {1.0, 0.1, 0.0}, std::nullopt, {}, std::nullopt}, {.kind = kind});
    EXPECT_FALSE(result.next);
    EXPECT_THAT(result.reason, HasSubstr("shut in"));
  }
}

TEST(Frontiers, SplitLongOnesAndCoverEveryBorderCell) {
  common::OccupancyGrid grid = common::makeOccupancyGrid(0.05);
  test::fill(grid, {{0, 0}, {120, 80}}, test::kFreeCell);
  const CostMap map = test::mapOf(grid);
  std::size_t cells = 0;
  for (const FrontierRun& run : findFrontiers(map, 1.5)) {
    EXPECT_LE(static_cast<double>(run.cells.size()) * 0.05, 3.1);
    EXPECT_NEAR(run.run_length_m, 396 * 0.05, 1e-9);
    cells += run.cells.size();
  }
  EXPECT_EQ(cells, 396u);
}

/// Of a place, from rays all around.
double localizabilityAt(const CostMap& map, common::CellIndex place, double range_m) {
  constexpr int kBeams = 90;
  const Directions directions(kBeams);
  std::vector<WallReturn> returns;
  const int max_steps = static_cast<int>(range_m / map.resolution_m());
  for (const Directions::Ray& ray : directions.rays()) {
    castRay(map, place, ray, static_cast<int>(max_steps / ray.step_cells), [&](int index, int) {
      if (map.states()[index] == CellState::kFree) return true;
      if (map.states()[index] == CellState::kOccupied)
        returns.push_back({map.centerOf(map.cellOf(index)) - map.centerOf(place), wallNormal(map, index)});
      return false;
    });
  }
  return localizability(returns, kBeams);
}

TEST(Localizability, RoomsFixThePoseCorridorsDoNot) {
  common::OccupancyGrid square = test::room(100, 100);
  common::OccupancyGrid corridor = test::room(1200, 40);
  const double in_room = localizabilityAt(test::mapOf(square), {50, 50}, 12.0);
  const double in_corridor = localizabilityAt(test::mapOf(corridor), {600, 20}, 12.0);
  const double at_its_end = localizabilityAt(test::mapOf(corridor), {30, 20}, 12.0);
  EXPECT_GT(in_room, 0.6);
  EXPECT_LT(in_corridor, 0.05);
  EXPECT_GT(at_its_end, 2.0 * in_corridor);
  EXPECT_GT(at_its_end, 0.1);
  EXPECT_LE(in_room, 1.0);
  EXPECT_EQ(localizability({}, 90), 0.0);
}

TEST(Localizability, TheShareOfWallsCountsOnlyDirectionsWhoseEndIsKnown) {
  const Directions directions(90);
  common::OccupancyGrid room = test::room(100, 100);
  EXPECT_DOUBLE_EQ(wallShareAt(test::mapOf(room), {50, 50}, 25.0, 8.0, directions), 1.0);
  common::OccupancyGrid plain = common::makeOccupancyGrid(0.05);
  test::fill(plain, {{0, 0}, {400, 400}}, test::kFreeCell);
  EXPECT_DOUBLE_EQ(wallShareAt(test::mapOf(plain), {200, 200}, 25.0, 8.0, directions), 0.0) << "free all around";
  common::OccupancyGrid small = common::makeOccupancyGrid(0.05);
  test::fill(small, {{0, 0}, {100, 100}}, test::kFreeCell);
  EXPECT_DOUBLE_EQ(wallShareAt(test::mapOf(small), {50, 50}, 25.0, 8.0, directions), 1.0)
      << "a wall may follow everywhere";
  test::fill(plain, {{0, 0}, {400, 200}}, test::kWallCell);
  EXPECT_NEAR(wallShareAt(test::mapOf(plain), {200, 220}, 25.0, 8.0, directions), 0.5, 0.05) << "a wall on one side";
}

}  // namespace
}  // namespace swiftlet::planning
