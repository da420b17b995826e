// LoadMap and Relocalize, as the autonomy carries them out.
#include "autonomy/map_shelf.hpp"

#include <gtest/gtest.h>

#include "autonomy/given_map/given_map_overlay.hpp"
#include "tests/autonomy/estimator_story.hpp"

namespace swiftlet::autonomy {
namespace {

TEST(MapShelf, LoadsWhatWasReadAndNothingElse) {
  EstimatorStory before(8.0);
  before.run(7.5);
  MapShelf shelf;
  shelf.offer({{"flat.yaml", {before.estimator.grid(), {}, 1}}});
  EstimatorStory story(16.0);
  GivenMapOverlay overlay(nullptr);
  story.run(2.5);
  story.estimator.setAtFlightHeight(true);
  EXPECT_FALSE(story.estimator.localization());

  const auto other = shelf.take({4, common::LoadMapRequest{"other.yaml"}}, story.estimator, overlay);
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->done);
  EXPECT_EQ(other->reason, "the map `other.yaml` was not read before the mission");
  EXPECT_FALSE(story.estimator.localization());
  EXPECT_EQ(shelf.problemOf("other.yaml"), other->reason);
  EXPECT_EQ(shelf.problemOf("flat.yaml"), "");

  const auto loaded = shelf.take({5, common::LoadMapRequest{"flat.yaml"}}, story.estimator, overlay);
  ASSERT_TRUE(loaded && loaded->done);
  EXPECT_EQ(loaded->id, 5u);
  story.run(15.5);
  ASSERT_TRUE(story.estimator.localization());
  EXPECT_TRUE(story.estimator.localization()->localized());

  ASSERT_TRUE(shelf.take({6, common::RelocalizeRequest{}}, story.estimator, overlay)->done);
  EXPECT_FALSE(story.estimator.localization()->localized());
}

TEST(MapShelf, LeavesOtherRequestsToOthersAndHasNothingToForgetWithoutAMap) {
  const MapShelf shelf;
  EstimatorStory story(3.0);
  GivenMapOverlay overlay(nullptr);
  EXPECT_FALSE(shelf.take({1, common::SaveMapRequest{"hall"}}, story.estimator, overlay));
  const auto answer = shelf.take({2, common::RelocalizeRequest{}}, story.estimator, overlay);
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->done);
  EXPECT_EQ(answer->reason, "the flight was given no map");
}

}  // namespace
}  // namespace swiftlet::autonomy
