// The parts of the world: a page is sent again what has changed, and nothing else.
#include "web/server/page_parts.hpp"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "common/world/trail.hpp"
#include "tests/rendering/example_flight.hpp"

namespace swiftlet::web {
namespace {

TEST(PagePartsTest, ALayerThatBothWorldsShareIsNotSentAgain) {
  testing::ExampleFlight flight;
  PageParts parts;
  const auto first = flight.advance(2.0);
  parts.update(first);
  const std::uint64_t levels = parts.levels().version, laser = parts.laser().version, tree = parts.tree().version();
  EXPECT_EQ(levels, 1u);
  EXPECT_EQ(laser, 1u);
  parts.update(first);
  parts.update(std::make_shared<common::World>(*first));
  EXPECT_EQ(parts.levels().version, levels);
  EXPECT_EQ(parts.laser().version, laser);
  EXPECT_EQ(parts.tree().version(), tree);
}

TEST(PagePartsTest, TheTrailIsSentWholeOnceItsPointsHaveMoved) {
  testing::ExampleFlight flight;
  test::Layers layers(*flight.advance(2.0));
  PageParts parts;
  const auto withTrail = [&](const std::vector<Eigen::Vector2d>& points_map_m) {
    layers.vehicle.trail = common::Trail(points_map_m);
    parts.update(std::make_shared<const common::World>(layers.world()));
    return parts.trailVersion();
  };
  const std::uint64_t at_first = withTrail({{0.0, 0.0}, {1.0, 0.0}});
  EXPECT_EQ(withTrail({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}), at_first);
  EXPECT_EQ(withTrail({{0.0, 0.0}, {1.0, 0.1}, {2.0, 0.0}}), at_first + 1);
}

}  // namespace
}  // namespace swiftlet::web
