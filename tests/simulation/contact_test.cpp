// What the truth says about contacts with glass, and about paths through the true free space.
#include <numbers>

#include <gtest/gtest.h>

#include "laser_fixtures.hpp"
#include "simulation/referee.hpp"
#include "simulation/truth_map.hpp"

namespace swiftlet::simulation {
namespace {

/// boxRoom() with a pane across it at x = 2.
WorldModel roomWithGlass() {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("pane", {2.0, -2.0, 0.0}, {2.02, 2.0, 3.0}));
  world.shapes.back().glass = true;
  return world;
}

Truth contactWithPane(const std::vector<bool>& seen) {
  const WorldModel world = roomWithGlass();
  const RayCaster rays(world);
  Referee referee(world, rays, Scenario());
  Truth truth;
  QuadrotorState state;
  state.T_world_body.position_m = {0, 0, 1};
  referee.judgeContacts(common::Time(), state, {}, {}, seen, truth);
  EXPECT_FALSE(truth.crashed);
  state.T_world_body.position_m = {1.9, 0, 1};
  referee.judgeContacts(common::Time::fromSeconds(0.01), state, {}, {}, seen, truth);
  EXPECT_TRUE(truth.crashed);
  return truth;
}

TEST(Contacts, WithGlassSayWhetherABeamEverReturnedFromIt) {
  std::vector<bool> seen(roomWithGlass().shapes.size(), true);
  EXPECT_TRUE(contactWithPane(seen).glass);
  EXPECT_FALSE(contactWithPane(seen).unseen_glass);
  EXPECT_FALSE(contactWithPane({}).unseen_glass) << "a laser whose beams all return has seen it";
  seen.back() = false;
  EXPECT_TRUE(contactWithPane(seen).unseen_glass);
}

std::vector<bool> seenFrom(const Eigen::Vector3d& position, double yaw_rad) {
  const WorldModel world = roomWithGlass();
  LaserErrorsConfig errors;
  errors.glass_angle_deg = 5.0;
  LaserScanner laser(quietLaser(), errors, world, 1);
  common::Pose3 pose;
  pose.position_m = position;
  pose.rotation = common::quaternionFrom({0.0, 0.0, yaw_rad});
  laser.scan(0, common::Time(), still(pose), RayCaster(world));
  return laser.seen();
}

TEST(Contacts, APaneIsSeenOnlyWhereABeamMeetsItNearlyUpright) {
  EXPECT_TRUE(seenFrom({0, 0, 1}, 0.0).back());
  EXPECT_FALSE(seenFrom({0, 3.5, 1}, 0.0).back()) << "beside the pane every beam meets it aslant";
  EXPECT_FALSE(seenFrom({0, 0, 1}, std::numbers::pi).back()) << "behind the laser's back";
  EXPECT_TRUE(seenFrom({0, 3.5, 1}, 0.0).front()) << "what is not glass counts as seen";
}

TEST(TruePaths, GoRoundWalls) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("wall", {-0.05, -2.0, 0.0}, {0.05, 4.0, 3.0}));
  const RayCaster rays(world);
  FreeSpaceQuery query;
  query.start_world_m = {-2.0, 1.0};
  query.hull_radius_m = 0.275;
  const auto reachable = reachableSpace(rays, query);
  EXPECT_NEAR(area_m2(reachable), 9.45 * 7.45 - 0.65 * 6.0, 1.5);
  EXPECT_NEAR(pathLength_m(reachable, {-2.0, 1.0}, {-1.0, 1.0}).value(), 1.0, 0.06);
  const double round_m = pathLength_m(reachable, {-2.0, 1.0}, {2.0, 1.0}).value();
  // Two tangents to a circle of the hull's radius about the wall's end, an arc of 123 degrees, the wall's width.
  const double taut_m = 2.0 * 3.567 + 0.275 * 2.143 + 0.1;
  EXPECT_GT(round_m, taut_m - 0.1);
  EXPECT_LT(round_m, 1.09 * taut_m + 0.1) << "steps to eight neighbours are at most 8.3 % longer";
  EXPECT_FALSE(pathLength_m(reachable, {-2.0, 1.0}, {0.0, 1.0})) << "inside the wall";
  EXPECT_FALSE(pathLength_m(reachable, {-20.0, 1.0}, {2.0, 1.0})) << "from outside";
}

}  // namespace
}  // namespace swiftlet::simulation
