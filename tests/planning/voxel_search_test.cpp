// Shortest paths over voxels: none is longer than that of a plain Dijkstra, and no corner is cut.
#include "planning/search/voxel_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "common/random.hpp"

namespace swiftlet::planning {
namespace {

using common::VoxelIndex;

/// Whether every voxel of the box around both is free.
bool isStep(const VoxelGrid& grid, const VoxelIndex& a, const VoxelIndex& b) {
  if (std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)}) != 1) return false;
  for (int z = std::min(a.z, b.z); z <= std::max(a.z, b.z); ++z)
    for (int y = std::min(a.y, b.y); y <= std::max(a.y, b.y); ++y)
      for (int x = std::min(a.x, b.x); x <= std::max(a.x, b.x); ++x)
        if (!grid.isFree({x, y, z})) return false;
  return true;
}

double stepLength(const VoxelIndex& a, const VoxelIndex& b) {
  return std::sqrt(std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z));
}

double naiveLength(const VoxelGrid& grid, const VoxelIndex& start, const VoxelIndex& goal) {
  std::map<VoxelIndex, double> length{{start, 0.0}};
  std::set<std::pair<double, VoxelIndex>> open{{0.0, start}};
  while (!open.empty()) {
    const auto [here_length, here] = *open.begin();
    open.erase(open.begin());
    if (here == goal) return here_length;
    if (here_length > length[here]) continue;
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const VoxelIndex to{here.x + x, here.y + y, here.z + z};
          if (!grid.isFree(here) || !isStep(grid, here, to)) continue;
          const double sum = here_length + stepLength(here, to);
          if (length.contains(to) && length[to] <= sum) continue;
          length[to] = sum;
          open.insert({sum, to});
        }
  }
  return -1.0;
}

TEST(VoxelSearch, EqualsDijkstraInRandomBoxes) {
  common::RandomStream random(11, "voxel search test");
  int found = 0, none = 0;
  for (int i = 0; i < 40; ++i) {
    VoxelGrid grid({9, 8, 7});
    const double share = random.uniform(0.1, 0.45);
    for (int z = 0; z < 7; ++z)
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 9; ++x)
          if (random.chance(share)) grid.block({x, y, z});
    VoxelSearch search(grid);
    for (int k = 0; k < 5; ++k) {
      const auto draw = [&] {
        return VoxelIndex{static_cast<int>(random.uniform(0, 9)), static_cast<int>(random.uniform(0, 8)),
                          static_cast<int>(random.uniform(0, 7))};
      };
      const VoxelIndex start = draw(), goal = draw();
      const auto path = search.plan(start, goal);
      const bool ends_free = grid.isFree(start) && grid.isFree(goal);
      const double naive = ends_free ? naiveLength(grid, start, goal) : -1.0;
      ASSERT_EQ(path.has_value(), naive >= 0.0);
      path ? ++found : ++none;
      if (!path) continue;
      EXPECT_NEAR(path->length, naive, 1e-9);
      double length = 0.0;
      for (std::size_t at = 1; at < path->voxels.size(); ++at) {
        EXPECT_TRUE(isStep(grid, path->voxels[at - 1], path->voxels[at]));
        length += stepLength(path->voxels[at - 1], path->voxels[at]);
      }
      EXPECT_NEAR(length, path->length, 1e-9);
      EXPECT_EQ(path->voxels.front(), start);
      EXPECT_EQ(path->voxels.back(), goal);
    }
  }
  EXPECT_GT(found, 50);
  EXPECT_GT(none, 20);
}

}  // namespace
}  // namespace swiftlet::planning
