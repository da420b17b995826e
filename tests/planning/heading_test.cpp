// The nose follows the way, and small moves are flown as they come.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planning/heading.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

double along(std::vector<Point> points, double yaw_rad) { return headingAlong(points, yaw_rad, {}); }

TEST(Heading, LongWaysAreFlownNoseFirst) {
  EXPECT_NEAR(along({{0, 0}, {0, 3}}, 0.0), kPi / 2, 1e-9);
  EXPECT_NEAR(std::abs(along({{0, 0}, {-3, 0}}, 0.0)), kPi, 1e-9);
}

TEST(Heading, TenCentimetresBackwardsAreNotWorthATurn) {
  EXPECT_EQ(along({{0, 0}, {-0.1, 0}}, 0.0), 0.0);
  EXPECT_EQ(along({{0, 0}, {0, 0.3}}, 0.0), 0.0);
}

TEST(Heading, LooksAroundTheCornerThatComes) {
  const double yaw_rad = along({{0, 0}, {0.4, 0}, {0.4, 3}}, 0.0);
  EXPECT_NEAR(yaw_rad, kPi / 4, 1e-9);
}

TEST(Heading, ASmallDeviationIsLeftAlone) { EXPECT_EQ(along({{0, 0}, {2, 0.05}}, 0.0), 0.0); }

TEST(Heading, WithoutAWayItStays) {
  EXPECT_EQ(along({}, 1.0), 1.0);
  EXPECT_EQ(along({{2, 2}}, 1.0), 1.0);
  EXPECT_EQ(along({{2, 2}, {2, 2}}, 1.0), 1.0);
}

}  // namespace
}  // namespace swiftlet::planning
