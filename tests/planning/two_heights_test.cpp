// Paths that change their height: below a beam, back up behind it, and never where the hull does not fit.
#include "planning/search/two_heights.hpp"
#include "planning/search/edge_cost.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grid_builder.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using testing::HasSubstr;
using Point = Eigen::Vector2d;

/// Two rooms of 8 m by 4 m, one above the other.
struct RoomAtTwoHeights : testing::Test {
  TwoHeights maps() { return {test::mapOf(upper), test::mapOf(lower), 0.5}; }
  tl::expected<Path, PlanFailure> plan(const Point& from, const Point& to, bool starts_lower = false) {
    return planAtTwoHeights(maps(), from, to, starts_lower, 1.0);
  }
  static bool lethal(const CostMap& map, const Point& place) {
    return map.costAt(map.cellAt(place)) == CostMap::kLethal;
  }

  common::OccupancyGrid upper = test::room(160, 80), lower = test::room(160, 80);
};

TEST_F(RoomAtTwoHeights, WithoutAnythingOverThePathTheHeightStays) {
  const auto path = plan({1.0, 2.0}, {7.0, 2.0});
  ASSERT_TRUE(path);
  EXPECT_FALSE(path->anyLowered());
  EXPECT_EQ(path->points_map_m, (std::vector<Point>{{1.0, 2.0}, {7.0, 2.0}}));
  EXPECT_NEAR(path->cost_m, 6.0, 0.1);
}

TEST_F(RoomAtTwoHeights, BelowABeamThePathIsLowerAndRisesBehindIt) {
  test::fill(upper, {{80, 0}, {83, 80}}, test::kWallCell);
  const auto path = plan({1.0, 2.0}, {7.0, 2.0});
  ASSERT_TRUE(path) << path.error().text;
  const std::size_t lines = path->points_map_m.size() - 1;
  ASSERT_EQ(path->lowered.size(), lines);
  EXPECT_FALSE(path->lowered.front());
  EXPECT_FALSE(path->lowered.back());
  double lowered_m = 0.0;
  for (std::size_t i = 0; i < lines; ++i) {
    const bool over = path->points_map_m[i].x() <= 4.0 && path->points_map_m[i + 1].x() >= 4.15;
    EXPECT_TRUE(!over || path->isLowered(i));
    if (path->isLowered(i)) lowered_m += (path->points_map_m[i + 1] - path->points_map_m[i]).norm();
  }
  // The beam is 0.15 m wide, and the hull comes down and rises 0.375 m before and behind it; no farther away than an
  // obstacle raises the cost, 0.6 m more.
  EXPECT_GT(lowered_m, 0.85);
  EXPECT_LT(lowered_m, 2.1);
  EXPECT_EQ(path->lower_height_m, 0.5);
  EXPECT_NEAR(path->length_m, 6.0, 0.2);
  EXPECT_GT(path->cost_m, path->length_m + 2.0) << "two changes of height";
}

TEST_F(RoomAtTwoHeights, WithoutAPlaceToComeDownThereIsNoPath) {
  test::fill(upper, {{80, 0}, {83, 80}}, test::kWallCell);
  // The last column where the hull fits above the floor at the height of flight is 72, the first one below is 73.
  test::fill(lower, {{0, 0}, {68, 80}}, common::occupancy::kUnknown);
  const auto path = plan({1.0, 2.0}, {7.0, 2.0});
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().reason, PlanFailure::Reason::kUnreachable);
}

TEST_F(RoomAtTwoHeights, AGoalBelowSomethingIsReachedAtTheLowerHeight) {
  test::fill(upper, {{80, 0}, {160, 80}}, test::kWallCell);
  const auto path = plan({1.0, 2.0}, {7.0, 2.0});
  ASSERT_TRUE(path);
  EXPECT_TRUE(path->lowered.back());
}

TEST_F(RoomAtTwoHeights, AVehicleThatIsLowerStartsThere) {
  test::fill(upper, {{80, 0}, {83, 80}}, test::kWallCell);
  const auto path = plan({4.1, 2.0}, {7.0, 2.0}, true);
  ASSERT_TRUE(path);
  EXPECT_TRUE(path->lowered.front());
  EXPECT_FALSE(path->lowered.back());
  EXPECT_EQ(path->escape_points, 0u);
}

TEST_F(RoomAtTwoHeights, AGoalThatIsFreeAtNeitherHeightIsRefusedWithTheReasonOfTheUpperOne) {
  test::fill(upper, {{130, 30}, {150, 50}}, test::kWallCell);
  test::fill(lower, {{130, 30}, {150, 50}}, common::occupancy::kUnknown);
  const auto path = plan({1.0, 2.0}, {7.0, 2.0});
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().reason, PlanFailure::Reason::kGoalBlocked);
}

/// The least cost by relaxing every edge of both maps until nothing changes: slow and obvious.
std::int64_t naiveCost(const TwoHeights& maps, CellIndex from, CellIndex to, bool ends_lower, std::int64_t change) {
  constexpr std::int64_t kFar = INT64_MAX / 2;
  const int cells = static_cast<int>(maps.upper.costs().size());
  std::vector<std::vector<std::int64_t>> cost(2, std::vector<std::int64_t>(maps.upper.costs().size(), kFar));
  cost[0][static_cast<std::size_t>(maps.upper.indexOf(from))] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t height = 0; height < 2; ++height)
      for (int i = 0; i < cells; ++i) {
        const CostMap& map = height == 0 ? maps.upper : maps.lower;
        if (map.isLethal(i)) continue;
        std::int64_t best = cost[height][static_cast<std::size_t>(i)];
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            if (dx == 0 && dy == 0) continue;
            const std::int32_t edge = edgeCost(map, i, dx, dy);
            if (edge == kNoEdge) continue;
            const int j = i + dy * map.rect().width() + dx;
            best = std::min(best, cost[height][static_cast<std::size_t>(j)] + edge + (height == 1 ? edge / 2 : 0));
          }
        const bool both = !maps.upper.isLethal(i) && !maps.lower.isLethal(i);
        if (both) best = std::min(best, cost[1 - height][static_cast<std::size_t>(i)] + change);
        if (best < cost[height][static_cast<std::size_t>(i)]) {
          cost[height][static_cast<std::size_t>(i)] = best;
          changed = true;
        }
      }
  }
  const std::int64_t least = cost[ends_lower ? 1 : 0][static_cast<std::size_t>(maps.upper.indexOf(to))];
  return least >= kFar ? -1 : least;
}

TEST_F(RoomAtTwoHeights, InRandomRoomsItFindsAPathWhereTheNaiveSearchDoesAndNoneIsDearer) {
  common::RandomStream random(24, "two heights");
  int found = 0, lowered = 0, none = 0;
  for (int round = 0; round < 150; ++round) {
    upper = test::room(70, 50);
    lower = test::room(70, 50);
    test::clutter(upper, {{12, 0}, {58, 50}}, 14, random);
    test::clutter(lower, {{12, 0}, {58, 50}}, 12, random);
    const Point from{0.6, 1.3}, to{2.9, 1.3};
    const TwoHeights both = maps();
    if (lethal(both.upper, from) || (lethal(both.upper, to) && lethal(both.lower, to))) continue;
    if (escapeFrom(both.upper, both.upper.cellAt(from))->size() > 1) continue;  // A pocket.
    const auto path = planAtTwoHeights(both, from, to, false, 0.5);
    const auto change = std::lround(0.5 / 0.05 * CostMap::kStraightMin);
    const std::int64_t least =
        naiveCost(both, both.upper.cellAt(from), both.upper.cellAt(to), lethal(both.upper, to), change);
    ASSERT_EQ(path.has_value(), least >= 0) << round;
    none += least < 0 ? 1 : 0;
    if (!path) continue;
    ++found;
    lowered += path->anyLowered() ? 1 : 0;
    // The ends are not at the middle of their cells, which may cost up to five times as much as the open.
    EXPECT_LE(path->cost_m, static_cast<double>(least) * 0.05 / CostMap::kStraightMin + 0.35) << round;
    for (std::size_t i = 0; i + 1 < path->points_map_m.size(); ++i) {
      const CostMap& map = path->isLowered(i) ? both.lower : both.upper;
      EXPECT_FALSE(segmentCost(map, path->points_map_m[i], path->points_map_m[i + 1]).lethal) << round << " " << i;
      if (i > 0 && path->isLowered(i) != path->isLowered(i - 1)) {
        EXPECT_FALSE(lethal(both.upper, path->points_map_m[i]) || lethal(both.lower, path->points_map_m[i])) << round;
      }
    }
  }
  EXPECT_GT(found, 20);
  EXPECT_GT(lowered, 5);
  EXPECT_GT(none, 2);
}

}  // namespace
}  // namespace swiftlet::planning
