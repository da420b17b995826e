// Polygons: what is inside, how far the edge is, and what is no polygon.
#include "common/polygon.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace swiftlet::common {
namespace {

/// An L: the square from 0 to 4 m without its upper right quarter.
const Polygon kCorner{{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}};

TEST(Polygon, IsInsideAlsoWhereItIsNotConvex) {
  EXPECT_TRUE(kCorner.contains({1, 3}));
  EXPECT_TRUE(kCorner.contains({3, 1}));
  EXPECT_FALSE(kCorner.contains({3, 3}));
  EXPECT_FALSE(kCorner.contains({-1, 2}));
  EXPECT_FALSE(Polygon{}.contains({0, 0}));
}

TEST(Polygon, MeasuresFromItsEdge) {
  EXPECT_NEAR(kCorner.signedDistance_m({3, 3}), 1.0, 1e-12);
  EXPECT_NEAR(kCorner.signedDistance_m({1, 1}), -1.0, 1e-12);
  EXPECT_NEAR(kCorner.signedDistance_m({-3, -4}), 5.0, 1e-12) << "a corner is nearest";
  EXPECT_NEAR(kCorner.area_m2(), 12.0, 1e-12);
}

TEST(Polygon, TellsWhatIsWrong) {
  EXPECT_FALSE(problemOf(kCorner));
  EXPECT_EQ(problemOf(Polygon{{{0, 0}, {1, 0}}})->name(), "polygon.too-few-corners");
  EXPECT_EQ(problemOf(Polygon{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}})->name(), "polygon.edges-cross");
  EXPECT_EQ(problemOf(Polygon{{{0, 0}, {4, 0}, {2, 0}, {2, 3}}})->name(), "polygon.edges-cross") << "a spike";
  EXPECT_EQ(problemOf(Polygon{{{0, 0}, {0.1, 0}, {0, 0.1}}})->name(), "polygon.no-area");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(problemOf(Polygon{{{0, 0}, {nan, 0}, {0, 1}}})->name(), "polygon.no-point");
  EXPECT_EQ(problemOf(Polygon{std::vector<Eigen::Vector2d>(65, {0, 0})})->name(), "polygon.too-many-corners");
}

}  // namespace
}  // namespace swiftlet::common
