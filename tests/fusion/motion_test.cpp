// The poses that the filter gives for the time of a sweep.
#include <gtest/gtest.h>

#include "tests/fusion/synthetic_flight.hpp"

namespace swiftlet::perception {
namespace {

using common::Duration;
using common::Time;

TEST(FilterMotion, InterpolatesPosesOfTheHistory) {
  SyntheticFlight flight(13, 8.0);
  ErrorStateFilter filter(withoutDrag());
  feed(filter, flight.imuSamples(), flight.deliveries(), flight.restUntil());
  const Time newest = filter.newest();
  const Time from = newest - Duration::fromMilliseconds(40);
  const PoseHistory history = filter.motion(from, newest);
  EXPECT_LE(history.poses().size(), 10u);
  for (int i = 0; i <= 1080; ++i) {
    const Time t = from + Duration::fromNanoseconds(std::int64_t{37'000} * i);
    if (t > newest) break;
    const auto a = history.at(t), b = filter.poseAt(t);
    ASSERT_TRUE(a && b);
    // Where something was measured between two samples, the pose jumps there, and the history runs straight across.
    EXPECT_LT((a->position_m - b->position_m).norm(), 0.005);
    EXPECT_LT(a->rotation.angularDistance(b->rotation), 0.002);
  }
  EXPECT_FALSE(filter.poseAt(newest - Duration::fromSeconds(3.0)));
  EXPECT_TRUE(filter.poseAt(newest + Duration::fromMilliseconds(15)));
  EXPECT_FALSE(filter.poseAt(newest + Duration::fromMilliseconds(50)));
  EXPECT_TRUE(
      filter.motion(newest, newest + Duration::fromMilliseconds(15)).covers(newest + Duration::fromMilliseconds(15)));
}

/// A sweep of the laser is placed by the motion. Along a bare wall each correction is centimetres, and beams before and
/// after it would lie that far apart.
TEST(FilterMotion, ACorrectionWithinASweepIsNoMotion) {
  SyntheticFlight flight(19, 8.0);
  ErrorStateFilter filter(withoutDrag());
  feed(filter, flight.imuSamples(), flight.deliveries(), flight.restUntil());
  const Time to = filter.newest(), from = to - Duration::fromMilliseconds(40),
             middle = to - Duration::fromMilliseconds(22);
  common::Pose2 aside = common::planar(*filter.poseAt(middle));
  aside.x_m += 0.05;
  ASSERT_EQ(filter.add(measuredAbsolutePose(middle, aside, 1e-8 * Eigen::Matrix3d::Identity())), Insertion::kTaken);
  const auto truth = [&](Time t) { return flight.motion.pose(t.seconds()).position_m; };
  const Eigen::Vector3d moved_m = truth(to) - truth(from);
  const Eigen::Vector3d jumped_m = filter.poseAt(to)->position_m - filter.poseAt(from)->position_m;
  EXPECT_GT((jumped_m - moved_m).norm(), 0.03) << "the estimate itself is corrected";
  const PoseHistory sweep = filter.motion(from, to);
  EXPECT_LT((sweep.at(to)->position_m - sweep.at(from)->position_m - moved_m).norm(), 0.004);
  EXPECT_LT((sweep.at(to)->position_m - filter.poseAt(to)->position_m).norm(), 1e-9);
}

}  // namespace
}  // namespace swiftlet::perception
