// When the given map is called that of another place.
#include "perception/localization/map_doubt.hpp"

#include <gtest/gtest.h>

namespace swiftlet::perception {
namespace {

class MapDoubtStory : public testing::Test {
 protected:
  /// A search `step_m` farther along the path, and the best of the places it found.
  void search(double step_m, double fit, double probability) { search(step_m, {{{}, fit, 0.0, probability, 0.0}}); }
  void search(double step_m, const std::vector<LikelyPlace>& places) {
    path_length_m_ += step_m;
    now_ += common::Duration::fromSeconds(step_m / speed_m_s_);
    doubt_.add(config_, places, path_length_m_, now_);
  }

  LocalizerConfig config_;
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

TEST_F(MapDoubtStory, ASingleSearchAfterALongWayDoesNotDecide) {
  search(0.0, 0.6, 0.3);
  search(12.0, 0.6, 0.3);
  EXPECT_FALSE(doubt_.refuted());
}

}  // namespace
}  // namespace swiftlet::perception
