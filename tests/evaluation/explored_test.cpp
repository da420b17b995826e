// Whether an exploration that said it was done was: against a flood of the true world.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/voxel_map.hpp"
#include "common/world/map3d_layer.hpp"
#include "evaluation/behavior_recorder.hpp"
#include "evaluation/criteria.hpp"
#include "evaluation/explored_check.hpp"
#include "evaluation/flight_score.hpp"
#include "evaluation/true_world.hpp"
#include "small_world.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::evaluation {
namespace {

/// In two rooms of 2 m by 3 m with an opening of 1 m between them; the vehicle took off at (1, 1) in the left one.
class ExploredStory : public testing::Test {
 protected:
  explicit ExploredStory(float gap_m = 1.0F) : rays_(smallWorld(gap_m)) {
    world_.rays = &rays_;
    T_world_map_.position_m = {1.0, 1.0, 0.0};
    explored_.keep_out = std::make_shared<const std::vector<common::Polygon>>();
    explored_.height_world_m = 1.0;
    know(4.0);
  }
  /// The map is right up to there.
  void know(double up_to_x_world_m) {
    common::OccupancyGrid map = common::makeOccupancyGrid(0.05);
    smallMap().forEachCell([&](common::CellIndex c, common::occupancy::Cell value) {
      if (!common::occupancy::isUnknown(value) && 0.05 * c.x < up_to_x_world_m) map.set({c.x - 20, c.y - 20}, value);
    });
    explored_.map = std::make_shared<const common::OccupancyGrid>(map);
  }
  std::optional<ExploredCheck> check() const { return checkExplored(explored_, world_, T_world_map_).area; }
  std::optional<double> unseen() const {
    const auto checked = check();
    return checked ? std::optional(checked->unseen_share) : std::nullopt;
  }

  simulation::RayCaster rays_;
  TrueWorld world_;
  common::Pose3 T_world_map_;
  BehaviorRecord::Explored explored_;
};

TEST_F(ExploredStory, ARoomThatWasLeftOutIsUnseen) {
  EXPECT_EQ(unseen(), 0.0);
  know(2.0);
  EXPECT_NEAR(unseen().value(), 0.5, 0.03);
}

TEST_F(ExploredStory, TheCertificateNamesWhatIsLeft) {
  EXPECT_THAT(certificateOf(check(), std::nullopt),
              testing::MatchesRegex("explored: all of [0-9.]+ m2 reachable was seen"));
  know(2.0);
  const auto left = check()->left;
  ASSERT_EQ(left.size(), 1u);
  EXPECT_NEAR(left[0].center_map_m.x(), 2.0, 0.2) << "the right room, 2 m from the start";
  EXPECT_NEAR(left[0].amount, 0.5 * check()->amount, 0.2);
  EXPECT_NEAR(left[0].height_m, 1.0, 1e-9);
  EXPECT_THAT(certificateOf(check(), std::nullopt),
              testing::MatchesRegex("explored: [0-9.]+ % of [0-9.]+ m2 reachable was not seen: [0-9.]+ m2 at .*"));
  explored_.keep_out =
      std::make_shared<const std::vector<common::Polygon>>(1, common::Polygon{{{0, 0}, {1, 0}, {1, 1}}});
  EXPECT_THAT(certificateOf(check(), std::nullopt), testing::HasSubstr("not judged"));
}

/// The camera could see both rooms from the left one and the right one; the 3D map has the left one only.
TEST_F(ExploredStory, OfTheVolumeWhatThe3dMapDoesNotHaveIsLeft) {
  world_.rgbd_camera.emplace();
  EXPECT_FALSE(checkExplored(explored_, world_, T_world_map_).volume) << "no 3D map";
  const auto knownUpTo = [&](double x_world_m) {
    common::VoxelMap map(0.1);
    for (int z = 0; z < 40; ++z)
      for (int y = -60; y < 80; ++y)
        for (int x = -60; x < static_cast<int>((x_world_m - 1.0) / 0.1); ++x) map.set({x, y, z}, -40);
    auto layer = std::make_shared<common::Map3dLayer>();
    layer->fused = std::make_shared<const common::VoxelMap>(std::move(map));
    explored_.map3d = layer;
    return checkExplored(explored_, world_, T_world_map_).volume;
  };
  const auto whole = knownUpTo(9.0);
  ASSERT_TRUE(whole);
  EXPECT_GT(whole->amount, 5.0);
  EXPECT_EQ(whole->unseen_share, 0.0);
  const auto half = knownUpTo(2.0);
  EXPECT_NEAR(half->unseen_share, 0.5, 0.15);
  ASSERT_FALSE(half->left.empty());
  EXPECT_GT(half->left[0].center_map_m.x(), 1.0);
  EXPECT_THAT(certificateOf(check(), half), testing::HasSubstr("m3 that the camera could see was not seen"));
}

TEST_F(ExploredStory, WhatIsOutOfBoundsIsNotAskedFor) {
  know(2.0);
  explored_.asked.bounds = common::MapBounds{{-1.0, -1.0}, {0.95, 2.0}, {}};
  EXPECT_NEAR(unseen().value(), 0.0, 1e-9);
  explored_.asked.bounds = common::MapBounds{{0.0, -1.0}, {2.0, 2.0}, {}};
  EXPECT_GT(unseen().value(), 0.4);
}

TEST_F(ExploredStory, BehindADoorThatIsClosedNothingIsAskedFor) {
  know(2.0);
  simulation::Actor door;
  door.position_world_m = {2.0, 2.5};
  door.half_size_m = {0.05, 0.5};
  door.radius_m = 0.0;
  explored_.closed_doors = {door};
  EXPECT_LT(unseen().value(), 0.05);
}

TEST_F(ExploredStory, WhatTheFloodDoesNotKnowIsNotJudged) {
  explored_.keep_out =
      std::make_shared<const std::vector<common::Polygon>>(1, common::Polygon{{{0, 0}, {1, 0}, {1, 1}}});
  EXPECT_FALSE(unseen());
  explored_.keep_out = std::make_shared<const std::vector<common::Polygon>>();
  world_.reachable_area_max_m2 = 1.0;
  EXPECT_FALSE(unseen()) << "an open world";
}

/// A hull of 0.55 m with 0.10 m around it fits through 0.78 m, but a map with cells of 5 cm may not show it.
struct NarrowStory : ExploredStory {
  NarrowStory() : ExploredStory(0.78F) {}
};

TEST_F(NarrowStory, AGapThatIsWiderByLessThanACellIsNotAskedFor) {
  know(2.0);
  EXPECT_LT(unseen().value(), 0.05);
  explored_.asked.clearance_m = 0.03;
  EXPECT_GT(unseen().value(), 0.3);
}

TEST(Explored, EachExplorationThatSucceedsIsRecordedOnceWithTheMapOfThatMoment) {
  BehaviorRecorder recorder;
  const auto map = [&] {
    const test::Layers layers;
    recorder.world(layers.world());
    return layers.map.grid;
  };
  common::ExploreIntent explore;
  explore.clearance_m = 0.2;
  const auto intent = [&](std::uint64_t id, common::IntentState state) {
    recorder.intent({id, explore}, {id, state, "", false, false});
  };
  const auto first = map();
  intent(1, common::IntentState::kRunning);
  EXPECT_TRUE(recorder.record().explored.empty());
  intent(1, common::IntentState::kSucceeded);
  intent(1, common::IntentState::kSucceeded);
  (void)map();
  intent(2, common::IntentState::kFailed);
  ASSERT_EQ(recorder.record().explored.size(), 1u);
  EXPECT_EQ(recorder.record().explored[0].map, first);
  EXPECT_EQ(recorder.record().explored[0].asked.clearance_m, 0.2);
}

/// No trial has to ask for it.
TEST(Explored, AnUntrueEndFailsATrial) {
  FlightScore score;
  score.mission_done = true;
  Criteria criteria;
  EXPECT_THAT(missed(score, criteria), testing::IsEmpty()) << "nothing was explored";
  score["explored_unseen_share"] = 0.04;
  EXPECT_THAT(missed(score, criteria), testing::IsEmpty());
  score["explored_unseen_share"] = 0.5;
  EXPECT_THAT(missed(score, criteria), testing::ElementsAre("share of the reachable area unseen when exploring was "
                                                            "done: 0.500, at most 0.05 was asked for"));
  score.mission_done = false;
  criteria.mission_done = false;
  EXPECT_EQ(missed(score, criteria).size(), 1u) << "however the flight ended";
  criteria["explored_unseen_max"] = 1.0;
  EXPECT_THAT(missed(score, criteria), testing::IsEmpty());
}

}  // namespace
}  // namespace swiftlet::evaluation
