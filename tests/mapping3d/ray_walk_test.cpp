// The voxels of a ray against a test of every voxel near it.
#include "mapping3d/voxels/ray_walk.hpp"

#include <random>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace swiftlet::mapping3d {
namespace {

using common::VoxelIndex;
using Eigen::Vector3d;

Vector3d randomPoint(std::mt19937& random) {
  std::uniform_real_distribution<double> within(-12.0, 12.0);
  return {within(random), within(random), within(random)};
}

std::vector<VoxelIndex> walked(const Vector3d& from, const Vector3d& to) {
  std::vector<VoxelIndex> cells;
  for (RayWalk walk(from, to);; walk.advance()) {
    cells.push_back(walk.cell());
    if (walk.atEnd()) return cells;
  }
}

/// Length of the segment within the cell, as a share.
double shareWithin(VoxelIndex cell, const Vector3d& from, const Vector3d& to) {
  double enters = 0.0, leaves = 1.0;
  const Vector3d least(cell.x, cell.y, cell.z);
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (least[axis] - from[axis]) / (to[axis] - from[axis]);
    const double b = (least[axis] + 1 - from[axis]) / (to[axis] - from[axis]);
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return leaves - enters;
}

TEST(RayWalk, VisitsTheCellsThatTheSegmentCrosses) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Vector3d from = randomPoint(random), to = randomPoint(random);
    const std::vector<VoxelIndex> cells = walked(from, to);
    const std::set<VoxelIndex> visited(cells.begin(), cells.end());
    EXPECT_EQ(visited.size(), cells.size());
    for (int x = -13; x < 13; ++x) {
      for (int y = -13; y < 13; ++y) {
        for (int z = -13; z < 13; ++z) {
          const double share = shareWithin({x, y, z}, from, to);
          if (std::abs(share) < 1e-9) continue;  // It touches an edge: either is right.
          EXPECT_EQ(visited.contains({x, y, z}), share > 0.0) << x << " " << y << " " << z;
        }
      }
    }
  }
}

TEST(RayWalk, ASegmentWithinACellIsThatCell) {
  EXPECT_EQ(walked({0.2, 0.3, 0.4}, {0.8, 0.1, 0.9}), (std::vector<VoxelIndex>{{0, 0, 0}}));
  EXPECT_EQ(walked({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}), (std::vector<VoxelIndex>{{0, 0, 0}}));
}

TEST(RayWalk, AlongAnAxisItVisitsOneCellAfterAnother) {
  EXPECT_EQ(walked({0.5, 0.5, 0.5}, {0.5, -2.5, 0.5}),
            (std::vector<VoxelIndex>{{0, 0, 0}, {0, -1, 0}, {0, -2, 0}, {0, -3, 0}}));
}

}  // namespace
}  // namespace swiftlet::mapping3d
