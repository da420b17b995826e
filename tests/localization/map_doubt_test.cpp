// When the given map is called that of another place.
#include "perception/localization/map_doubt.hpp"

#include <gtest/gtest.h>

namespace swiftlet::perception {
namespace {

class MapDoubtStory : public testing::Test {
 protected:
  /// A search `step_m` farther along the path, and the best of the places it found.
  void search(double step_m, double fit, double probability) { search(step_m, {{{}, fit, 0.0, probability, 0.0}}); }
  void search(double step_m, const std::vector<LikelyPlace>& places) { add(step_m, places, true); }
  void searchGivenUp(double step_m, const std::vector<LikelyPlace>& places) { add(step_m, places, false); }
  void add(double step_m, const std::vector<LikelyPlace>& places, bool complete) {
    move(step_m);
    doubt_.add(places, complete, path_length_m_, now_);
  }
  /// Flies on while the map explains what is seen.
  void believe(double step_m) {
    move(step_m);
    doubt_.believe(path_length_m_, now_);
  }
  void move(double step_m) {
    path_length_m_ += step_m;
    now_ += common::Duration::fromSeconds(step_m / speed_m_s_);
  }

  MapDoubt doubt_;
  double path_length_m_ = 0.0, speed_m_s_ = 0.7;
  common::Time now_;
};

TEST_F(MapDoubtStory, NoPlaceFitsForTwoAndAHalfMetres) {
  search(0.0, 0.6, 0.3);
  for (int i = 0; i < 4; ++i) search(0.5, 0.67, 0.6);
  EXPECT_FALSE(doubt_.refuted());
  search(0.5, 0.6, 0.2);
  EXPECT_TRUE(doubt_.refuted());
}

TEST_F(MapDoubtStory, NothingThatComesNearCountsTwice) {
  search(0.0, {});
  for (int i = 0; i < 2; ++i) search(0.5, {});
  EXPECT_FALSE(doubt_.refuted());
  search(0.5, {});
  EXPECT_TRUE(doubt_.refuted());
}

TEST_F(MapDoubtStory, ASearchThatWasGivenUpSaysNothing) {
  for (int i = 0; i < 100; ++i) searchGivenUp(0.5, {});
  EXPECT_FALSE(doubt_.refuted()) << "more places fit than can be told apart";
  search(0.5, {});
  EXPECT_FALSE(doubt_.refuted()) << "the path to searches that were given up is not that of the next one";
}

TEST_F(MapDoubtStory, APlaceOfASearchThatWasGivenUpConvincesNobody) {
  search(0.0, 0.6, 0.3);
  for (int i = 0; i < 5; ++i) search(0.5, 0.6, 0.3);
  for (int i = 0; i < 20; ++i) searchGivenUp(0.5, {{{}, 0.8, 0.0, 1.0, 0.0}});
  EXPECT_TRUE(doubt_.refuted()) << "other places may be as good";
}

TEST_F(MapDoubtStory, AMapThatWasBelievedIsRefutedByAsLongAPathAndMore) {
  believe(0.0);
  for (int i = 0; i < 20; ++i) believe(0.2);
  for (int i = 0; i < 12; ++i) search(0.5, 0.6, 0.3);
  EXPECT_FALSE(doubt_.refuted()) << "6 m against it, 4 m for it";
  for (int i = 0; i < 2; ++i) search(0.5, 0.6, 0.3);
  EXPECT_TRUE(doubt_.refuted());
  for (int i = 0; i < 5; ++i) search(0.5, 0.8, 0.99);
  EXPECT_FALSE(doubt_.refuted()) << "it is believed again like any other";
}

TEST_F(MapDoubtStory, ConvincingSearchesTakeNothingOfThePathOnWhichItWasBelieved) {
  believe(0.0);
  believe(4.0);
  for (int i = 0; i < 4; ++i) search(0.5, 0.8, 0.99);
  for (int i = 0; i < 12; ++i) search(0.5, 0.6, 0.3);
  EXPECT_FALSE(doubt_.refuted());
}

TEST_F(MapDoubtStory, ASlowVehicleNeedsTenSeconds) {
  speed_m_s_ = 0.1;
  search(0.0, 0.6, 0.3);
  for (int i = 0; i < 2; ++i) search(0.35, 0.67, 0.6);
  EXPECT_FALSE(doubt_.refuted());
  search(0.35, 0.67, 0.6);
  EXPECT_TRUE(doubt_.refuted());
}

TEST_F(MapDoubtStory, OneConvincingSearchDoesNotMakeItStartAnew) {
  search(0.0, 0.6, 0.3);
  for (int i = 0; i < 4; ++i) search(0.5, 0.67, 0.6);
  search(0.5, 0.7, 0.96);
  search(0.5, 0.6, 0.2);
  EXPECT_FALSE(doubt_.refuted());
  search(0.5, 0.6, 0.2);
  EXPECT_TRUE(doubt_.refuted());
}

TEST_F(MapDoubtStory, ItIsBelievedAgainWhenAsMuchSpeaksForIt) {
  search(0.0, 0.6, 0.3);
  for (int i = 0; i < 20; ++i) search(0.5, 0.67, 0.6);
  for (int i = 0; i < 4; ++i) search(0.5, 0.8, 0.99);
  EXPECT_TRUE(doubt_.refuted());
  search(0.5, 0.8, 0.99);
  EXPECT_FALSE(doubt_.refuted()) << "two and a half metres, however long it did not fit before";
}

TEST_F(MapDoubtStory, ALongHoverDoesNotDecide) {
  search(0.0, 0.6, 0.3);
  now_ += common::Duration::fromSeconds(600);
  search(0.4, 0.6, 0.3);
  EXPECT_FALSE(doubt_.refuted());
}

TEST_F(MapDoubtStory, TwoLikeRoomsAreNoReason) {
  for (int i = 0; i < 100; ++i) search(0.5, 0.85, 0.5);
  EXPECT_FALSE(doubt_.refuted()) << "either fits";
}

TEST_F(MapDoubtStory, AMapInWhichMuchHasMovedIsNoReason) {
  for (int i = 0; i < 100; ++i) search(0.5, 0.68, 0.99);
  EXPECT_FALSE(doubt_.refuted()) << "only one fits at all";
}

TEST_F(MapDoubtStory, AProbablePlaceThatHardlyFitsIsNotConvincing) {
  search(0.0, 0.5, 1.0);
  for (int i = 0; i < 5; ++i) search(0.5, 0.5, 1.0);
  EXPECT_TRUE(doubt_.refuted());
}

TEST_F(MapDoubtStory, ASingleSearchAfterALongPathDoesNotDecide) {
  search(0.0, 0.6, 0.3);
  search(12.0, 0.6, 0.3);
  EXPECT_FALSE(doubt_.refuted());
}

}  // namespace
}  // namespace swiftlet::perception
