// What the beams below met, cell by cell.
#include "perception/altitude/seen_surfaces.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace swiftlet::perception {
namespace {

TEST(SeenSurfaces, ACellOverAnEdgeHasBothSurfacesAndNoMixedBeam) {
  SeenSurfaces seen;
  common::RandomStream random(1, "beams");
  for (int i = 0; i < 200; ++i) {
    seen.add({random.uniform(1.0, 1.1), 0.05}, random.gaussian(0.012));
    seen.add({random.uniform(1.0, 1.1), 0.05}, 0.2 + random.gaussian(0.012));
  }
  seen.add({1.05, 0.05}, 0.1);  // It hit the edge.
  seen.add({1.05, 0.05}, std::numeric_limits<double>::quiet_NaN());
  bool floor = false, platform = false;
  for (const common::Level& level : seen.surfaces().levels) {
    ASSERT_EQ(level.cells, std::vector<common::CellIndex>({{10, 0}}));
    floor = floor || std::abs(level.height_m) < 0.03;
    platform = platform || std::abs(level.height_m - 0.2) < 0.03;
    EXPECT_GT(std::abs(level.height_m - 0.1), 0.04);
  }
  EXPECT_TRUE(floor && platform);
}

TEST(SeenSurfaces, AFlatFloorIsOneSurface) {
  SeenSurfaces seen;
  common::RandomStream random(1, "beams");
  for (int i = 0; i < 5000; ++i) seen.add({random.uniform(0.0, 1.0), random.uniform(0.0, 0.2)}, random.gaussian(0.015));
  for (const common::Level& level : seen.surfaces().levels) EXPECT_LT(std::abs(level.height_m), 0.065);
}

}  // namespace
}  // namespace swiftlet::perception
