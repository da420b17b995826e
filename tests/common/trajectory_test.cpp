// A trajectory from poses in any order, and its pose at a time.
#include "common/trajectory.hpp"

#include <deque>

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

/// A pose each second from 1 to 3 s that moves along x and turns by 0.4 rad.
Trajectory turning() {
  Trajectory poses;
  for (int i = 1; i <= 3; ++i) poses.push_back({Time::fromSeconds(i), lifted({2.0 * i, 0.0, 0.4 * i}, 1.0)});
  return poses;
}

TEST(PoseAt, IsBetweenItsNeighbours) {
  const auto pose = poseAt(turning(), Time::fromSeconds(1.25));
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->position_m.x(), 2.5, 1e-12);
  EXPECT_EQ(pose->position_m.z(), 1.0);
  EXPECT_NEAR(yawOf(pose->rotation), 0.5, 1e-12);
}

TEST(PoseAt, IsThePoseItselfAtItsStampTheFirstAndTheLastToo) {
  const Trajectory poses = turning();
  for (const StampedPose& at : poses) EXPECT_EQ(poseAt(poses, at.stamp)->position_m, at.pose.position_m);
}

TEST(PoseAt, IsNoneBeyondTheEnds) {
  const Trajectory poses = turning();
  EXPECT_FALSE(poseAt(poses, poses.front().stamp - Duration::fromNanoseconds(1)));
  EXPECT_FALSE(poseAt(poses, poses.back().stamp + Duration::fromNanoseconds(1)));
  EXPECT_FALSE(poseAt(Trajectory{}, Time::fromSeconds(1)));
}

TEST(PoseAt, IsNoneInAGapThatIsTooLongButAtItsEnds) {
  const Trajectory poses = turning();
  const auto at = [&](double time_s, int longest_ms) {
    return poseAt(poses, Time::fromSeconds(time_s), Duration::fromMilliseconds(longest_ms)).has_value();
  };
  EXPECT_TRUE(at(1.5, 1000));
  EXPECT_FALSE(at(1.5, 999));
  EXPECT_TRUE(at(2.0, 999)) << "a recorded pose needs no neighbour";
}

TEST(PoseAt, TakesADeque) {
  const Trajectory poses = turning();
  EXPECT_TRUE(poseAt(std::deque<StampedPose>(poses.begin(), poses.end()), Time::fromSeconds(2.5)));
}

TEST(NearestTo, IsTheEarlierOfTwoThatAreEquallyNear) {
  const Trajectory poses = turning();
  EXPECT_EQ(nearestTo(poses, Time::fromSeconds(-5)), 0u);
  EXPECT_EQ(nearestTo(poses, Time::fromSeconds(1.4)), 0u);
  EXPECT_EQ(nearestTo(poses, Time::fromSeconds(1.5)), 0u);
  EXPECT_EQ(nearestTo(poses, Time::fromSeconds(1.6)), 1u);
  EXPECT_EQ(nearestTo(poses, Time::fromSeconds(99)), 2u);
}

TEST(Blended, DiffersFromSlerpByLessThanAMicroradianBetweenNeighbours) {
  const Pose3 first = lifted({0.0, 0.0, 3.13}, 0.0);
  Pose3 second = lifted({1.0, 2.0, 3.17}, 0.5);
  for (const double sign : {1.0, -1.0}) {  // A quaternion and its negative are the same rotation.
    second.rotation.coeffs() *= sign;
    const Pose3 fast = blended(first, second, 0.3), exact = interpolated(first, second, 0.3);
    EXPECT_EQ(fast.position_m, exact.position_m);
    EXPECT_LT(fast.rotation.angularDistance(exact.rotation), 1e-6);
  }
}

}  // namespace
}  // namespace swiftlet::common
