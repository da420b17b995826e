// A path that grows at its end while others read its earlier state.
#include "common/world/trail.hpp"

#include <gtest/gtest.h>

namespace swiftlet::common {
namespace {

std::vector<Eigen::Vector2d> pointsOf(const Trail& trail) {
  return {trail.points_map_m().begin(), trail.points_map_m().end()};
}

TEST(Trail, DoesNotChangeWhileTheRecorderContinues) {
  TrailRecorder recorder;
  std::vector<Trail> taken{recorder.trail()};
  std::vector<Eigen::Vector2d> flown;
  for (int i = 0; i < 500; ++i) {
    flown.emplace_back(i, -i);
    recorder.add(flown.back());
    taken.push_back(recorder.trail());
  }
  for (std::size_t i = 0; i < taken.size(); ++i)
    ASSERT_EQ(pointsOf(taken[i]),
              std::vector<Eigen::Vector2d>(flown.begin(), flown.begin() + static_cast<std::ptrdiff_t>(i)));
}

TEST(Trail, IsRarelyCopied) {
  TrailRecorder recorder;
  int copies = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Eigen::Vector2d* const before = recorder.trail().points_map_m().data();
    recorder.add({i, 0});
    copies += recorder.trail().points_map_m().data() != before;
  }
  EXPECT_LE(copies, 10);
}

TEST(Trail, ContinuesEveryTrailThatItBeginsWith) {
  TrailRecorder recorder;
  recorder.add({1, 2});
  const Trail one = recorder.trail();
  for (int i = 0; i < 100; ++i) recorder.add({i, 3});
  const Trail many = recorder.trail();
  EXPECT_TRUE(many.continues(one));
  EXPECT_TRUE(many.continues(many));
  EXPECT_TRUE(many.continues(Trail{}));
  EXPECT_FALSE(one.continues(many));
  EXPECT_TRUE(many.continues(Trail({{1, 2}}))) << "equal points of another trail";
  EXPECT_FALSE(many.continues(Trail({{1, 1}})));
}

}  // namespace
}  // namespace swiftlet::common
