// Moving objects are found where the map of some seconds ago shows free space, tracked, and forgotten.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "perception/people/dynamic_obstacles.hpp"
#include "tests/planning/grid_builder.hpp"

namespace swiftlet::perception {
namespace {

using common::Time;
using Point = Eigen::Vector2d;

/// The side of a disc that faces the sensor.
std::vector<Eigen::Vector2f> front(const Point& center, double radius_m, const Point& sensor) {
  std::vector<Eigen::Vector2f> points;
  const double facing = std::atan2(sensor.y() - center.y(), sensor.x() - center.x());
  for (double a = -1.2; a <= 1.2; a += 0.08)
    points.push_back((center + radius_m * Point(std::cos(facing + a), std::sin(facing + a))).cast<float>());
  return points;
}

struct MovingObjects : testing::Test {
  common::OccupancyGrid grid = planning::test::room(200, 160);
  DynamicObstacles tracker;
  Point sensor{5, 4};
  /// Level with the body, unless told.
  SeenPoints seen(std::vector<Eigen::Vector2f> points_map_m, float above_body_m = 0.0F) const {
    const std::vector<float> heights(points_map_m.size(), above_body_m);
    return {sensor, std::move(points_map_m), heights};
  }
  static Time at(double s) { return Time::fromSeconds(s); }
};

TEST_F(MovingObjects, WallsAndUnknownSpaceAreNotMoving) {
  planning::test::fill(grid, {{150, 100}, {190, 150}}, common::occupancy::kUnknown);
  std::vector<Eigen::Vector2f> points;
  for (int i = 0; i < 100; ++i) points.push_back({10.02f, 1.0f + 0.05f * static_cast<float>(i)});  // a wall
  for (int i = 0; i < 20; ++i) points.push_back({8.0f + 0.05f * static_cast<float>(i), 6.0f});     // never seen
  points.push_back({NAN, 1.0f});
  points.push_back({5.5f, 4.5f});  // a speck of noise
  tracker.update(at(0), seen(points), grid);
  EXPECT_TRUE(tracker.obstacles().empty());
}

TEST_F(MovingObjects, APersonIsOneDiscWithAVelocity) {
  const int id = 1;
  for (int i = 0; i <= 40; ++i) {
    const double t = i * 0.025;
    tracker.update(at(t), seen(front({7.5, 2.5 + t}, 0.25, sensor)), grid);
    ASSERT_EQ(tracker.obstacles().size(), 1u) << t;
    EXPECT_EQ(tracker.obstacles()[0].id, id);
  }
  const common::DynamicObstacle& person = tracker.obstacles()[0];
  EXPECT_NEAR((person.center_map_m - Point(7.5, 3.5)).norm(), 0.0, 0.15);
  EXPECT_NEAR((person.velocity_map_m_s - Point(0, 1)).norm(), 0.0, 0.25);
  EXPECT_NEAR(person.radius_m, 0.2, 0.1);
}

TEST_F(MovingObjects, DetectsAWalkerWithinHalfASecondAndAfterAnOcclusion) {
  const auto walk = [&](double from_s, double to_s) {
    double known_s = to_s;
    for (double t = from_s; t < to_s; t += 0.025) {
      tracker.update(at(t), seen(front({7.5, 2.5 + t}, 0.25, sensor)), grid);
      if (tracker.anyMoves()) known_s = std::min(known_s, t);
    }
    return known_s;
  };
  EXPECT_LT(walk(0.0, 1.0), 0.5);
  for (double t = 1.0; t < 1.5; t += 0.025) tracker.update(at(t), seen({}), grid);
  (void)walk(1.5, 2.5);
  EXPECT_TRUE(tracker.anyMoves());
}

/// The person stood when the map began, so the map shows the person, and nothing behind. A wall that comes into view
/// where the person stood is not a walker.
TEST_F(MovingObjects, DetectsOneWhoWalksStraightAwayFromTheLaser) {
  planning::test::fill(grid, {{138, 70}, {200, 90}}, common::occupancy::kUnknown);
  planning::test::fill(grid, {{135, 76}, {138, 84}}, planning::test::kWallCell);  // At x = 6.75 m.
  const auto view = [&](const std::vector<Eigen::Vector2f>& seen) {
    std::vector<Eigen::Vector2f> points;
    for (int i = 0; i < 10; ++i) points.push_back({9.99f, 3.0f + 0.05f * static_cast<float>(i)});
    for (auto point = seen.rbegin(); point != seen.rend(); ++point) points.push_back(*point);
    for (int i = 0; i < 10; ++i) points.push_back({9.99f, 4.55f + 0.05f * static_cast<float>(i)});
    return points;
  };
  for (int i = 0; i < 60; ++i)
    tracker.update(at(0.025 * i), seen(view(front({7.0 + 0.0125 * i, 4.0}, 0.25, sensor))), grid);
  EXPECT_TRUE(tracker.anyMoves());
  std::vector<Eigen::Vector2f> wall;
  for (int i = 0; i < 12; ++i) wall.push_back({7.6f, 3.75f + 0.05f * static_cast<float>(i)});
  DynamicObstacles other;
  for (int i = 0; i < 60; ++i) other.update(at(0.025 * i), seen(wall), grid);
  EXPECT_TRUE(other.obstacles().empty());
}

/// Seen from a place that is wrong by more than a metre along a corridor, its end is where the map has free space.
TEST_F(MovingObjects, TheEndOfACorridorThatIsNotWhereTheMapHasItIsNotAPerson) {
  std::vector<Eigen::Vector2f> end, side;
  for (int i = 0; i < 20; ++i) end.push_back({3.8f, 4.48f - 0.05f * static_cast<float>(i)});
  for (int i = 0; i < 6; ++i) side.push_back({3.9f + 0.05f * static_cast<float>(i), 3.5f});
  const auto from = [&](std::size_t first) {
    std::vector<Eigen::Vector2f> points(end.begin() + static_cast<std::ptrdiff_t>(first), end.end());
    points.insert(points.end(), side.begin(), side.end());
    return points;
  };
  planning::test::fill(grid, {{60, 60}, {200, 69}}, planning::test::kWallCell);  // The corridor's side at y = 3.45 m.
  for (const std::size_t first : {0u, 8u, 15u}) {
    for (int i = 0; i < 8; ++i) tracker.update(at(0.025 * i), seen(from(first)), grid);
    EXPECT_TRUE(tracker.obstacles().empty()) << first << " points of it are out of the field of view";
  }
  // A person who stands against the same side of the corridor ends where the beams pass the person.
  std::vector<Eigen::Vector2f> person(end.begin() + 12, end.end());
  person.insert(person.begin(), Eigen::Vector2f(1.0f, 4.6f));
  person.insert(person.end(), side.begin(), side.end());
  for (int i = 0; i < 8; ++i) tracker.update(at(1.0 + 0.025 * i), seen(person), grid);
  EXPECT_EQ(tracker.obstacles().size(), 1u);
}

/// A nodding laser hits a lower object: it appears in one scan of four, each time elsewhere.
TEST_F(MovingObjects, AnIntermittentObjectIsNotAWalker) {
  for (int i = 0; i < 120; ++i) {
    const double t = i * 0.025;
    const std::vector<Eigen::Vector2f> met = front({7.5, 3.6 + 0.2 * (i / 4 % 4)}, 0.25, sensor);
    tracker.update(at(t), seen(i % 4 == 0 ? met : std::vector<Eigen::Vector2f>{}), grid);
    EXPECT_FALSE(tracker.anyMoves()) << t;
  }
  EXPECT_FALSE(tracker.obstacles().empty()) << "it is there all the same";
}

/// A dipping laser meets the top of a table farther and farther away. A person is higher than the vehicle flies.
TEST_F(MovingObjects, TheTopOfATableIsNotAWalker) {
  for (const float above_body_m : {-0.1F, 0.05F}) {
    DynamicObstacles fresh;
    for (double t = 0.0; t < 1.0; t += 0.025)
      fresh.update(at(t), seen(front({7.5, 2.5 + t}, 0.25, sensor), above_body_m), grid);
    EXPECT_EQ(fresh.anyMoves(), above_body_m > 0.0F);
    EXPECT_EQ(fresh.obstacles().size(), 1u) << "it is there all the same";
  }
}

/// A vehicle that accelerates, or hangs in the wind, looks down at a person; who was once seen as high as the body is
/// tall.
TEST_F(MovingObjects, WhoWasSeenAsHighAsTheBodyRemainsAWalker) {
  for (double t = 0.0; t < 4.0; t += 0.025)
    tracker.update(at(t), seen(front({7.5, 2.0 + t}, 0.25, sensor), t < 0.1 ? -0.06F : -0.15F), grid);
  EXPECT_TRUE(tracker.anyMoves()) << "-0.06 m is the height of the body, 3 m away";
}

TEST_F(MovingObjects, DiscsArePredictedAndExpire) {
  for (int i = 0; i <= 40; ++i) {
    const double t = i * 0.025;
    tracker.update(at(t), seen(front({7.5, 2.5 + t}, 0.25, sensor)), grid);
  }
  double farthest_y = 0.0;
  for (const common::Disc& disc : tracker.discs(at(1.0), 0.5)) farthest_y = std::max(farthest_y, disc.center_map_m.y());
  EXPECT_GT(farthest_y, 3.7);
  // Out of sight it is kept for a while.
  tracker.update(at(4.5), seen({}), grid);
  EXPECT_EQ(tracker.obstacles().size(), 1u) << "who walks comes out again";
  EXPECT_TRUE(tracker.discs(at(4.5)).empty()) << "the planner knows nothing of where";
  tracker.update(at(5.5), seen({}), grid);
  EXPECT_TRUE(tracker.obstacles().empty());
}

TEST_F(MovingObjects, BeamsThroughItsPlaceRemoveADisc) {
  for (int i = 0; i < 10; ++i) tracker.update(at(i * 0.025), seen(front({7.5, 4}, 0.25, sensor)), grid);
  ASSERT_EQ(tracker.obstacles().size(), 1u);
  std::vector<Eigen::Vector2f> wall;
  for (int i = -10; i <= 10; ++i) wall.push_back({10.02f, 4.0f + 0.02f * static_cast<float>(i)});
  tracker.update(at(0.6), seen(wall), grid);
  EXPECT_TRUE(tracker.obstacles().empty());
}

TEST_F(MovingObjects, TwoPeopleAreTwoDiscs) {
  std::vector<Eigen::Vector2f> points = front({7.5, 3.2}, 0.25, sensor);
  for (const auto& p : front({7.5, 4.8}, 0.25, sensor)) points.push_back(p);
  tracker.update(at(0), seen(points), grid);
  EXPECT_EQ(tracker.obstacles().size(), 2u);
}

}  // namespace
}  // namespace swiftlet::perception
