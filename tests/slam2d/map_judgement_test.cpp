// Whether a finished map contradicts itself: two rounds of a ring of corridors, right and bent.
#include "perception/slam2d/map_judgement.hpp"

#include <deque>

#include <gtest/gtest.h>

#include "tests/slam2d/ring.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

constexpr double kRange_m = 20.0;
constexpr int kEvery = 2;  ///< Of the scans of the ring, 0.25 m apart, every second one is a key scan.

/// Two rounds, each key scan at T(index, truth).
template <typename Place>
MapJudgement judged(Place&& place) {
  std::deque<ProjectedScan> scans;
  std::vector<PlacedScan> keys;
  int taken = 0;
  test::Ring().fly(2.0, [&](const ProjectedScan& scan, const Pose2&, const Eigen::Matrix3d&, const Pose2& truth) {
    if (taken++ % kEvery != 0) return;
    scans.push_back(scan);
    keys.push_back({&scans.back(), place(keys.size(), truth)});
  });
  return judgeMap(keys, kRange_m);
}

TEST(MapJudgement, ARightMapAgreesWithItself) {
  const MapJudgement right = judged([](std::size_t, const Pose2& truth) { return truth; });
  EXPECT_GT(right.agreeing.size(), 30U);
  EXPECT_TRUE(right.contradicting.empty());
  EXPECT_EQ(right.violation(), 0.0);
}

TEST(MapJudgement, WallsThatAreDrawnTwiceContradict) {
  std::size_t keys = 0;
  (void)judged([&](std::size_t i, const Pose2& truth) {
    keys = i;
    return truth;
  });
  const std::size_t round = keys / 2;
  const MapJudgement bent = judged([&](std::size_t i, const Pose2& truth) {
    return i > round ? Pose2{1.5, -1.2, 0.0} * truth : truth;  // The second round beside the first.
  });
  EXPECT_GT(bent.violation(), 0.10);
  ASSERT_FALSE(bent.contradicting.empty());
  const SeenTwice& worst = bent.contradicting.front();
  EXPECT_LE(worst.first_key, round);
  EXPECT_GT(worst.other_key + 12, round);
  for (std::size_t i = 1; i < bent.contradicting.size(); ++i)
    EXPECT_LE(bent.contradicting[i].violation, bent.contradicting[i - 1].violation);
}

TEST(MapJudgement, ASingleRoundHasLittleToCompare) {
  const MapJudgement nothing = judgeMap({}, kRange_m);
  EXPECT_EQ(nothing.pairs(), 0U);
  EXPECT_EQ(nothing.violation(), 0.0);
}

}  // namespace
}  // namespace swiftlet::perception
