// When the given map is called that of another place.
#include "perception/localization/map_doubt.hpp"

#include <gtest/gtest.h>

namespace swiftlet::perception {
namespace {

class MapDoubtStory : public testing::Test {
 protected:
  void search(double path_length_m, double explained, double probability) {
    LikelyPlace place;
    place.explained = explained;
    place.probability = probability;
    doubt_.add(config_, {place}, path_length_m);
  }

  LocalizerConfig config_;
  MapDoubt doubt_;
};

TEST_F(MapDoubtStory, NoPlaceStandsOutForLong) {
  search(7.5, 0.7, 0.3);
  search(8.0, 0.75, 0.6);
  EXPECT_FALSE(doubt_.refuted());
  search(8.5, 0.7, 0.2);
  EXPECT_TRUE(doubt_.refuted());
  search(9.0, 0.7, 0.95);
  EXPECT_FALSE(doubt_.refuted()) << "one stands out after all";
}

TEST_F(MapDoubtStory, TheFirstMetresTellNothing) {
  for (int i = 0; i < 10; ++i) search(0.6 * i, 0.7, 0.3);
  EXPECT_FALSE(doubt_.refuted());
}

TEST_F(MapDoubtStory, TwoLikeRoomsAreNoReason) {
  for (int i = 0; i < 10; ++i) search(10.0 + i, 0.9, 0.5);
  EXPECT_FALSE(doubt_.refuted()) << "either explains nearly all";
}

TEST_F(MapDoubtStory, AMapInWhichMuchHasMovedIsNoReason) {
  for (int i = 0; i < 10; ++i) search(10.0 + i, 0.66, 0.99);
  EXPECT_FALSE(doubt_.refuted()) << "only one explains it";
}

}  // namespace
}  // namespace swiftlet::perception
