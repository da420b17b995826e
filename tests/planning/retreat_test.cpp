// The course away from a person, flown as a point mass with latency: never into an obstacle, and no faster than
// necessary.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "common/random.hpp"
#include "grid_builder.hpp"
#include "planning/avoidance/retreat.hpp"
#include "tests/planning/avoidance_story.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;

using test::kHull_m;
using test::kTick_s;

Threat person(const Point& center_m, const Point& velocity_m_s) { return {center_m, 0.25, velocity_m_s, true, ""}; }

/// A vehicle that flies its commands a tenth of a second late. The level frame keeps the map's heading.
struct Flyer {
  void tick() {
    std::vector<Point> seen;
    for (const Point& p : walls_m) seen.push_back(p - place_m);
    std::vector<Threat> around = threats;
    for (Threat& threat : around) threat.center_m -= place_m;
    answer_m_s =
        retreatChoice(config, kHull_m,
                      {velocity_m_s, seen, around, answer_m_s, {place_m.x(), place_m.y(), 0.0}, map, config.latency_s})
            .velocity_level_m_s;
    fastest_m_s = std::max(fastest_m_s, answer_m_s.norm());
    late.push_back(answer_m_s);
    const Point wanted = late.size() > 4 ? late.front() : velocity_m_s;
    if (late.size() > 4) late.pop_front();
    const Point change = wanted - velocity_m_s;
    const double most = kRetreatAcceleration_m_s2 * kTick_s;
    velocity_m_s += change.norm() > most ? Point(change.normalized() * most) : change;
    place_m += velocity_m_s * kTick_s;
    for (Threat& threat : threats) threat.center_m += threat.velocity_m_s * kTick_s;
    for (const Point& p : walls_m) least_wall_m = std::min(least_wall_m, (p - place_m).norm());
    for (const Threat& threat : threats) least_gap_m = std::min(least_gap_m, threat.gapTo(kHull_m, place_m, 0.0));
  }
  void fly(double seconds) {
    for (double t = 0.0; t < seconds; t += kTick_s) tick();
  }
  void addWall(const Point& from_m, const Point& to_m) {
    const int count = static_cast<int>((to_m - from_m).norm() / 0.02);
    for (int i = 0; i <= count; ++i) walls_m.push_back(from_m + (to_m - from_m) * i / count);
  }

  AvoidanceConfig config;
  Point place_m = Point::Zero(), velocity_m_s = Point::Zero(), answer_m_s = Point::Zero();
  std::vector<Threat> threats;
  std::vector<Point> walls_m;
  const Clearance* map = nullptr;
  std::deque<Point> late;
  double fastest_m_s = 0.0;
  double least_wall_m = std::numeric_limits<double>::infinity();
  double least_gap_m = std::numeric_limits<double>::infinity();
};

TEST(Retreat, MovesAwayFromAPersonWhoComesStraightOn) {
  Flyer flyer;
  flyer.threats = {person({1.8, 0.0}, {-1.0, 0.0})};
  flyer.fly(1.0);
  EXPECT_GT(flyer.velocity_m_s.norm(), 0.3);
  flyer.fly(4.0);
  EXPECT_GT(flyer.least_gap_m, 0.1);
}

TEST(Retreat, MovesAsideForAPassingPerson) {
  Flyer flyer;
  flyer.threats = {person({0.45, 1.6}, {0.0, -1.0})};
  flyer.fly(3.0);
  EXPECT_GT(flyer.least_gap_m, 0.2);
  EXPECT_LT(flyer.place_m.x(), -0.1);
  EXPECT_GT(flyer.place_m.y(), -0.4);
}

TEST(Retreat, StaysInPlaceWhenThatIsEnough) {
  Flyer flyer;
  flyer.threats = {person({1.2, 1.5}, {0.0, -1.0})};
  flyer.fly(3.0);
  EXPECT_EQ(flyer.fastest_m_s, 0.0);
}

TEST(Retreat, MovesNoFasterThanNecessary) {
  Flyer flyer;
  flyer.threats = {person({0.85, 0.0}, {0.0, 0.0})};
  flyer.fly(3.0);
  EXPECT_GT(flyer.threats[0].gapTo(kHull_m, flyer.place_m, 0.0), 0.30);
  EXPECT_LE(flyer.fastest_m_s, 0.5 * kRetreatSpeed_m_s);
}

TEST(Retreat, AllowsForItsTurningDistanceAtSpeed) {
  // The collision that led to this rule: the vehicle flies along a wall beside it, and a person comes from the other
  // side.
  Flyer flyer;
  flyer.addWall({-6.0, -0.5}, {6.0, -0.5});
  flyer.velocity_m_s = {0.7, -0.1};
  flyer.threats = {person({1.3, 1.8}, {-0.3, -0.9})};
  flyer.fly(2.5);
  EXPECT_GT(flyer.least_wall_m, kHull_m + 0.05);
  EXPECT_GT(flyer.least_gap_m, 0.0);
}

TEST(Retreat, NeverFliesIntoObstacles) {
  // Random walls and people: the vehicle keeps the margin to walls, or the distance of an immediate stop if that is
  // less.
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    common::RandomStream random(seed, "retreat");
    Flyer flyer, stopper;
    for (int i = 0; i < 3; ++i) {
      const double bearing_rad = random.uniform(-3.14, 3.14), off_m = random.uniform(0.5, 1.2);
      const Point normal(std::cos(bearing_rad), std::sin(bearing_rad)), along(-normal.y(), normal.x());
      flyer.addWall(off_m * normal - 2.0 * along, off_m * normal + 2.0 * along);
    }
    flyer.velocity_m_s = stopper.velocity_m_s = {random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)};
    for (int i = 0; i < 2; ++i) {
      const double bearing_rad = random.uniform(-3.14, 3.14), towards_rad = bearing_rad + random.uniform(-0.5, 0.5);
      flyer.threats.push_back(person(1.5 * Point(std::cos(bearing_rad), std::sin(bearing_rad)),
                                     -random.uniform(0.2, 1.2) * Point(std::cos(towards_rad), std::sin(towards_rad))));
    }
    stopper.walls_m = flyer.walls_m;
    stopper.fly(2.0);  // No person comes: it stops.
    flyer.fly(3.0);
    const double allowed_m = std::min(stopper.least_wall_m, kHull_m + flyer.config.retreat_margin_m);
    EXPECT_GT(flyer.least_wall_m, allowed_m - 0.03) << seed;
  }
}

TEST(Retreat, UsesTheMapForWallsOutsideTheView) {
  common::OccupancyGrid grid = test::room(100, 100);
  test::fill(grid, {{0, 0}, {32, 100}}, test::kWallCell);
  CostMap map({}, 0.05);
  map.update(grid.snapshot(), {});
  Flyer flyer;
  flyer.map = &map.clearance();
  flyer.place_m = {2.1, 2.5};  // 0.5 m right of the wall that no return shows.
  flyer.threats = {person({3.0, 2.5}, {-0.6, 0.0})};
  flyer.fly(1.0);
  EXPECT_GT(flyer.place_m.x(), 1.6 + kHull_m + flyer.config.retreat_margin_m - 0.05);
}

TEST(Retreat, StopsWithoutAThreat) {
  Flyer flyer;
  flyer.velocity_m_s = {0.5, 0.2};
  flyer.fly(2.0);
  EXPECT_EQ(flyer.velocity_m_s.norm(), 0.0);
}

}  // namespace
}  // namespace swiftlet::planning
