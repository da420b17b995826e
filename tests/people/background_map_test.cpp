// A person is visible against the map of some seconds ago.
#include <gtest/gtest.h>

#include "perception/people/background_map.hpp"

namespace swiftlet::perception {
namespace {

using common::Duration;
using common::Time;

TEST(BackgroundMap, ReturnsTheNewestMapThatIsOldEnough) {
  BackgroundMap background(Duration::fromSeconds(2));
  EXPECT_EQ(background.at(Time::fromSeconds(0)), nullptr);
  std::vector<std::shared_ptr<const common::OccupancyGrid>> grids;
  for (int i = 0; i < 5; ++i) {
    grids.push_back(std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(0.05)));
    background.add(Time::fromSeconds(i), grids.back());
  }
  EXPECT_EQ(background.at(Time::fromSeconds(1)), grids[0]);
  EXPECT_EQ(background.at(Time::fromSeconds(4)), grids[2]);
  EXPECT_EQ(background.at(Time::fromSeconds(5.5)), grids[3]);
  background.restart();
  EXPECT_EQ(background.at(Time::fromSeconds(6)), nullptr);
}

}  // namespace
}  // namespace swiftlet::perception
