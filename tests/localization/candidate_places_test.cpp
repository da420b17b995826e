// The places where a robot may be, between two wings that look alike.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "perception/localization/localizer.hpp"
#include "tests/localization/lost_cases.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using common::Time;

TEST(CandidatePlaces, BothOfTwoAlikeAreThereWithTheirWeightsAndMoveWithTheRobot) {
  const test::Building building = test::twinWings(2);
  common::RandomStream noise(2, "candidates");
  const Pose2 T_map_grid{2.0, -1.0, 0.5};
  Localizer localizer(test::mapOf(building), T_map_grid, {}, 2);
  LocalizationEstimate estimate;
  for (int i = 0; i < 40; ++i) {
    const Pose2 truth{6.0 + 0.06 * i, 0.05, 0.0};
    const auto scan = test::levelScan(building.world, truth, Time::fromSeconds(0.1 * i), noise);
    estimate = localizer.add({scan, Pose2{0.06 * i, 0.0, 0.0}, Eigen::Matrix3d::Zero(), true, false});
    if (i < 20 || estimate.candidates.empty()) continue;
    double nearest_m = 1e9, weights = 0.0;
    for (const common::PlaceCandidate& candidate : estimate.candidates) {
      const Pose2 off = between(T_map_grid * truth, candidate.T_given_body);
      nearest_m = std::min(nearest_m, off.position_m().norm());
      weights += candidate.weight;
    }
    EXPECT_LT(nearest_m, 0.2) << i << ": the true one, also between two searches";
    EXPECT_LE(weights, 1.0 + 1e-9);
  }
  ASSERT_GE(estimate.candidates.size(), 2u);
  EXPECT_TRUE(std::is_sorted(estimate.candidates.begin(), estimate.candidates.end(),
                             [](const auto& a, const auto& b) { return a.weight > b.weight; }));
  EXPECT_LT(estimate.candidates[0].weight, 0.9) << "nothing tells one from the other";
  EXPECT_GT(estimate.candidates[1].weight, 0.1);
}

TEST(CandidatePlaces, NoneWhenThePoseIsKnown) {
  const test::Building building = test::offices(3);
  common::RandomStream noise(3, "candidates");
  Localizer localizer(test::mapOf(building), {}, {}, 3);
  const test::Walks walks(building);
  test::Walker walker(walks, 3);
  localizer.startAt(walker.pose(), Eigen::Vector3d(0.01, 0.01, 0.001).asDiagonal());
  const auto scan = test::levelScan(building.world, walker.pose(), Time::fromSeconds(1.0), noise);
  EXPECT_TRUE(localizer.add({scan, {}, Eigen::Matrix3d::Zero(), true, false}).candidates.empty());
}

}  // namespace
}  // namespace swiftlet::perception
