// LoadMap and Relocalize, as the autonomy carries them out.
#include "autonomy/map_shelf.hpp"

#include <gtest/gtest.h>

#include "tests/autonomy/estimator_story.hpp"

namespace swiftlet::autonomy {
namespace {

/// The estimator hears of the order in one tick.
void carryOut(const MapShelf::Answer& answer, EstimatorStory& story) {
  Feedback feedback = story.feedback;
  feedback.given_map = {*answer.order};
  story.estimator.hear(feedback);
}

TEST(MapShelf, LoadsWhatWasReadAndNothingElse) {
  EstimatorStory before(8.0);
  before.run(7.5);
  MapShelf shelf;
  shelf.offer({{"flat.yaml", {before.estimator.maps().grid, {}, 1}}});
  EstimatorStory story(16.0);
  story.run(2.5);
  story.feedback.at_flight_height = true;
  EXPECT_FALSE(story.estimator.maps().localization);

  const auto other = shelf.take({4, common::LoadMapRequest{"other.yaml"}}, false);
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->answer.done);
  EXPECT_FALSE(other->order);
  EXPECT_EQ(shelf.problemOf("other.yaml")->name(), "map.not-offered");
  EXPECT_EQ(shelf.problemOf("other.yaml")->text(), other->answer.reason);
  EXPECT_FALSE(shelf.problemOf("flat.yaml"));

  const auto loaded = shelf.take({5, common::LoadMapRequest{"flat.yaml"}}, false);
  ASSERT_TRUE(loaded && loaded->answer.done && loaded->order);
  EXPECT_EQ(loaded->answer.id, 5u);
  carryOut(*loaded, story);
  story.run(15.5);
  ASSERT_TRUE(story.estimator.maps().localization);
  EXPECT_TRUE(story.estimator.maps().localization->localized());

  const auto anew = shelf.take({6, common::RelocalizeRequest{}}, true);
  ASSERT_TRUE(anew && anew->answer.done && anew->order);
  carryOut(*anew, story);
  EXPECT_FALSE(story.estimator.maps().localization->localized());
}

TEST(MapShelf, LeavesOtherRequestsToOthersAndHasNothingToForgetWithoutAMap) {
  const MapShelf shelf;
  EXPECT_FALSE(shelf.take({1, common::SaveMapRequest{"hall"}}, false));
  const auto answer = shelf.take({2, common::RelocalizeRequest{}}, false);
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->answer.done);
  EXPECT_FALSE(answer->order);
  EXPECT_EQ(answer->answer.reason, "the flight was given no map");
}

}  // namespace
}  // namespace swiftlet::autonomy
