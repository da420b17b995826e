// The rules of the papers for the course of a retreat.
#include <vector>

#include <gtest/gtest.h>

#include "planning/avoidance/retreat_rules.hpp"

namespace swiftlet::planning {
namespace {

using Eigen::Vector2d;

struct Scene {
  AvoidanceConfig config;
  std::vector<Vector2d> points;
  std::vector<Threat> threats;
  RetreatInput input() const { return {Vector2d::Zero(), points, threats, Vector2d::Zero(), {}, nullptr, 0.1}; }
};

TEST(OppositeRule, Flies180DegreesFromTheNearestCollision) {
  Scene scene;
  scene.threats = {{{1.0, 1.0}, 0.1, Vector2d::Zero(), true, "near"},
                   {{0.0, -2.0}, 0.1, Vector2d::Zero(), true, "far"}};
  const Vector2d flown = oppositeVelocity(scene.config, 0.275, scene.input());
  EXPECT_LT((flown - scene.config.retreat_speed_m_s * Vector2d(-1, -1).normalized()).norm(), 1e-9);
  scene.threats[0].dangerous = scene.threats[1].dangerous = false;
  EXPECT_TRUE(oppositeVelocity(scene.config, 0.275, scene.input()).isZero());
}

// What the rule of 180 deg does not see: it flies into the wall behind, where the field turns aside.
TEST(PotentialField, TurnsAsideOfAWallBehind) {
  Scene scene;
  scene.threats = {{{0.6, 0.0}, 0.1, Vector2d::Zero(), true, "person"}};
  for (double y = -1.0; y <= 0.3; y += 0.02) scene.points.emplace_back(-0.5, y);
  const Vector2d opposite = oppositeVelocity(scene.config, 0.275, scene.input());
  const Vector2d field = potentialFieldVelocity(scene.config, 0.275, scene.input());
  EXPECT_LT(opposite.x(), -0.6);
  EXPECT_GT(field.y(), 0.03);
  EXPECT_GT(field.x(), opposite.x());
  EXPECT_NEAR(field.norm(), scene.config.retreat_speed_m_s, 1e-9);
}

TEST(PotentialField, IsZeroWhereNothingIsNearOrAllCancels) {
  Scene scene;
  scene.points = {{3.0, 0.0}};
  EXPECT_TRUE(potentialFieldVelocity(scene.config, 0.275, scene.input()).isZero());
  scene.points = {{0.8, 0.0}, {-0.8, 0.0}};
  EXPECT_TRUE(potentialFieldVelocity(scene.config, 0.275, scene.input()).isZero());
}

}  // namespace
}  // namespace swiftlet::planning
