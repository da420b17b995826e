// Poses in any order become a trajectory, and errors of the order are counted.
#include "common/trajectory.hpp"

#include <gtest/gtest.h>

namespace swiftlet::common {
namespace {

/// Poses whose x is their position in the file.
std::vector<StampedPose> posesAt(std::initializer_list<int> stamps_s) {
  std::vector<StampedPose> poses;
  for (const int stamp_s : stamps_s)
    poses.push_back({Time::fromSeconds(stamp_s), lifted({static_cast<double>(poses.size()), 0, 0}, 0)});
  return poses;
}

TEST(Ordered, DoesNotChangeAnOrderedTrajectory) {
  const Ordered result = ordered(posesAt({1, 2, 5}));
  ASSERT_EQ(result.trajectory.size(), 3u);
  EXPECT_EQ(result.trajectory[2].pose.position_m.x(), 2);
  EXPECT_EQ(result.went_back, 0u);
  EXPECT_EQ(result.repeated, 0u);
  EXPECT_TRUE(ordered({}).trajectory.empty());
}

TEST(Ordered, SortsAndKeepsTheLastPoseOfEachStamp) {
  // 2 after 3 and 1 after 3 go back; the second 3 and the second and third 2 repeat.
  const Ordered result = ordered(posesAt({2, 3, 2, 2, 3, 1}));
  ASSERT_EQ(result.trajectory.size(), 3u);
  EXPECT_EQ(result.trajectory[0].pose.position_m.x(), 5);
  EXPECT_EQ(result.trajectory[1].pose.position_m.x(), 3);
  EXPECT_EQ(result.trajectory[2].pose.position_m.x(), 4);
  EXPECT_EQ(result.went_back, 2u);
  EXPECT_EQ(result.repeated, 3u);
}

}  // namespace
}  // namespace swiftlet::common
