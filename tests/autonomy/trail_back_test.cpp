// The trail as a path home.
#include "autonomy/trail_back.hpp"

#include <gtest/gtest.h>

#include "common/segment.hpp"

namespace swiftlet::autonomy {
namespace {

using Points = std::vector<Eigen::Vector2d>;

void fly(Points& trail_m, const Eigen::Vector2d& to_m) {
  const Eigen::Vector2d from_m = trail_m.back();
  const double length_m = (to_m - from_m).norm();
  for (double s_m = 0.05; s_m < length_m; s_m += 0.05) trail_m.push_back(from_m + s_m / length_m * (to_m - from_m));
  trail_m.push_back(to_m);
}

TEST(TrailBack, LeadsToTheStart) {
  EXPECT_TRUE(trailBackWithoutLoops(Points{}).empty());
  Points trail_m{{0.0, 0.0}};
  EXPECT_EQ(trailBackWithoutLoops(trail_m), trail_m);
  fly(trail_m, {4.0, 0.0});
  fly(trail_m, {4.0, 3.0});
  const Points back_m = trailBackWithoutLoops(trail_m);
  EXPECT_EQ(back_m.front(), trail_m.back());
  EXPECT_LT(back_m.back().norm(), 0.25);
  EXPECT_NEAR(common::polylineLength(back_m), 7.0, 0.4);
}

TEST(TrailBack, LeavesOutRoomsThatWereLeftByTheDoorTheyWereEnteredBy) {
  Points trail_m{{0.0, 0.0}};
  fly(trail_m, {5.0, 0.0});
  for (int round = 0; round < 4; ++round) {
    fly(trail_m, {5.0, 4.0});
    fly(trail_m, {9.0, 4.0});
    fly(trail_m, {5.1, 0.1});
  }
  fly(trail_m, {5.0, -2.0});
  ASSERT_GT(common::polylineLength(trail_m), 60.0);
  const Points back_m = trailBackWithoutLoops(trail_m);
  EXPECT_LT(common::polylineLength(back_m), 7.6) << "the trail out is 7 m";
  for (std::size_t i = 1; i < back_m.size(); ++i) EXPECT_LT((back_m[i] - back_m[i - 1]).norm(), 0.26);
}

}  // namespace
}  // namespace swiftlet::autonomy
