// The types everything else is built on: time, transforms, grids, random streams, jobs.
#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/random.hpp"
#include "common/time.hpp"

namespace swiftlet::common {
namespace {

double arbitrary(double low, double high) {
  return low + (high - low) * static_cast<double>(*rc::gen::inRange(0, 1'000'001)) * 1e-6;
}
Pose2 arbitraryPose2() { return {arbitrary(-50, 50), arbitrary(-50, 50), arbitrary(-3.1, 3.1)}; }

TEST(Time, DifferencesAreExact) {
  const Time a = Time::fromNanoseconds(1'000'000'007), b = Time::fromNanoseconds(5);
  EXPECT_EQ((a - b).nanoseconds(), 1'000'000'002);
  EXPECT_EQ(b + (a - b), a);
}

TEST(Geometry, WrapAngleStaysWithinMinusPiAndPi) {
  EXPECT_DOUBLE_EQ(wrapAngle(M_PI), M_PI);
  EXPECT_DOUBLE_EQ(wrapAngle(-M_PI), M_PI);
  EXPECT_NEAR(wrapAngle(7.0), 7.0 - 2 * M_PI, 1e-12);
}

TEST(Geometry, Pose2IsAGroup) {
  EXPECT_TRUE(rc::check([] {
    const Pose2 a = arbitraryPose2(), b = arbitraryPose2(), c = arbitraryPose2();
    const Pose2 left = (a * b) * c, right = a * (b * c), one = a * a.inverse();
    RC_ASSERT(std::hypot(left.x_m - right.x_m, left.y_m - right.y_m) < 1e-9);
    RC_ASSERT(std::abs(wrapAngle(left.yaw_rad - right.yaw_rad)) < 1e-9);
    RC_ASSERT(std::hypot(one.x_m, one.y_m) + std::abs(one.yaw_rad) < 1e-9);
  }));
}

TEST(Geometry, ExponentialAndLogarithmInvertEachOther) {
  EXPECT_TRUE(rc::check([] {
    const Eigen::Vector3d v(arbitrary(-1.7, 1.7), arbitrary(-1.7, 1.7), arbitrary(-1.7, 1.7));
    RC_ASSERT((logSO3(expSO3(v)) - v).norm() < 1e-9);
  }));
}

TEST(Geometry, RollPitchYawRoundTrip) {
  EXPECT_TRUE(rc::check([] {
    const RollPitchYaw in{arbitrary(-3, 3), arbitrary(-1.5, 1.5), arbitrary(-3, 3)};
    const RollPitchYaw out = rollPitchYaw(quaternionFrom(in));
    RC_ASSERT(std::abs(in.roll_rad - out.roll_rad) + std::abs(in.pitch_rad - out.pitch_rad) +
                  std::abs(in.yaw_rad - out.yaw_rad) <
              1e-8);
  }));
}

TEST(TiledGrid, GrowsInAllDirectionsAndKeepsValues) {
  EXPECT_TRUE(rc::check([] {
    TiledGrid<int> grid(0.05, -7);
    std::map<std::pair<int, int>, int> oracle;
    for (int i = 0; i < 200; ++i) {
      const CellIndex c{*rc::gen::inRange(-300, 300), *rc::gen::inRange(-300, 300)};
      grid.set(c, i);
      oracle[{c.x, c.y}] = i;
    }
    for (const auto& [key, value] : oracle) RC_ASSERT(grid.at({key.first, key.second}) == value);
    RC_ASSERT(grid.at({10'000, 0}) == -7);
  }));
}

TEST(TiledGrid, SnapshotDoesNotSeeLaterWritesAndSharesUntouchedTiles) {
  TiledGrid<int> grid(0.1, 0);
  grid.set({1, 1}, 5);
  grid.set({100, 1}, 6);
  TiledGrid<int> before = grid.snapshot();
  grid.set({1, 1}, 9);
  EXPECT_EQ(before.at({1, 1}), 5);
  EXPECT_EQ(grid.at({1, 1}), 9);
  EXPECT_NE(before.tileIdentity({1, 1}), grid.tileIdentity({1, 1}));
  EXPECT_EQ(before.tileIdentity({100, 1}), grid.tileIdentity({100, 1}));
  before.set({100, 1}, 1);
  EXPECT_EQ(grid.at({100, 1}), 6);
}

TEST(TiledGrid, CellAtFloorsNegativeCoordinates) {
  const TiledGrid<int> grid(0.05);
  EXPECT_EQ(grid.cellAt(-0.01, 0.01), (CellIndex{-1, 0}));
  EXPECT_EQ(grid.cellAt(grid.centerOf({-64, 63})), (CellIndex{-64, 63}));
}

TEST(RandomStream, StreamsAreIndependentAndRepeatable) {
  RandomStream a(7, "laser", 3), b(7, "laser", 3), c(7, "laser", 4), d(7, "imu", 3);
  const auto first = a.bits();
  EXPECT_EQ(first, b.bits());
  EXPECT_NE(first, c.bits());
  EXPECT_NE(first, d.bits());
}

TEST(RandomStream, GaussianHasUnitVariance) {
  RandomStream stream(1, "test");
  double sum = 0, squares = 0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    const double g = stream.gaussian();
    sum += g;
    squares += g * g;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.02);
  EXPECT_NEAR(squares / kCount, 1.0, 0.02);
}

}  // namespace
}  // namespace swiftlet::common
