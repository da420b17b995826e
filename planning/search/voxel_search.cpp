#include "planning/search/voxel_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <queue>

namespace swiftlet::planning {
namespace {

using common::VoxelIndex;

/// Whole numbers compare the same on every machine: the roots are right within 1e-9.
constexpr std::int64_t kStraight = 1'000'000'000, kFaceDiagonal = 1'414'213'562, kSpaceDiagonal = 1'732'050'808;

struct Move {
  int dx, dy, dz;
  int axes;
  std::int64_t cost;
  std::uint32_t needs;  ///< The bits of freeAround() that must be set.
};

/// The bit of a neighbour, or of the voxel itself.
constexpr int bitOf(int dx, int dy, int dz) { return (dz + 1) * 9 + (dy + 1) * 3 + dx + 1; }

constexpr int kMoves = 26;

std::array<Move, kMoves> allMoves() {
  constexpr std::array<std::int64_t, 3> kCosts{kStraight, kFaceDiagonal, kSpaceDiagonal};
  std::array<Move, kMoves> moves{};
  std::size_t count = 0;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (const int axes = std::abs(dx) + std::abs(dy) + std::abs(dz); axes > 0) {
          std::uint32_t needs = 0;
          for (const int z : {0, dz})
            for (const int y : {0, dy})
              for (const int x : {0, dx}) needs |= 1U << bitOf(x, y, z);
          moves.at(count++) = {dx, dy, dz, axes, kCosts.at(static_cast<std::size_t>(axes - 1)), needs};
        }
  return moves;
}

const std::array<Move, kMoves> kMove = allMoves();

/// The cost where nothing is in the way.
std::int64_t octileCost(const VoxelIndex& a, const VoxelIndex& b) {
  std::array<int, 3> off{std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)};
  std::sort(off.begin(), off.end());
  return kSpaceDiagonal * off[0] + kFaceDiagonal * (off[1] - off[0]) + kStraight * (off[2] - off[1]);
}

struct OpenVoxel {
  std::int64_t estimate, cost;
  VoxelIndex voxel;
  /// Of equal estimates the one nearer to the goal comes first.
  bool operator<(const OpenVoxel& other) const {
    if (estimate != other.estimate) return estimate > other.estimate;
    if (cost != other.cost) return cost < other.cost;
    return voxel > other.voxel;
  }
};

}  // namespace

VoxelGrid::VoxelGrid(VoxelIndex size)
    : size_(size),
      blocked_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z)) {
}

VoxelSearch::VoxelSearch(const VoxelGrid& grid) : grid_(grid) {
  const auto pages = [](int side) { return (side >> kPageBits) + 1; };
  pages_size_ = {pages(grid.size().x), pages(grid.size().y), pages(grid.size().z)};
  pages_.resize(static_cast<std::size_t>(pages_size_.x) * static_cast<std::size_t>(pages_size_.y) *
                static_cast<std::size_t>(pages_size_.z));
}

VoxelSearch::Node& VoxelSearch::nodeAt(const VoxelIndex& voxel) {
  constexpr int kSide = 1 << kPageBits;
  const auto place = [](const VoxelIndex& at, int width, int depth) {
    return (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(depth) + static_cast<std::size_t>(at.y)) *
               static_cast<std::size_t>(width) +
           static_cast<std::size_t>(at.x);
  };
  const VoxelIndex page{voxel.x >> kPageBits, voxel.y >> kPageBits, voxel.z >> kPageBits};
  auto& nodes = pages_[place(page, pages_size_.x, pages_size_.y)];
  if (!nodes) nodes = std::make_unique<Page>(static_cast<std::size_t>(kSide) * kSide * kSide);
  return (*nodes)[place({voxel.x & (kSide - 1), voxel.y & (kSide - 1), voxel.z & (kSide - 1)}, kSide, kSide)];
}

/// A bit for the voxel and for each of its neighbours.
std::uint32_t VoxelSearch::freeAround(const VoxelIndex& voxel) const {
  std::uint32_t free = 0;
  int bit = 0;
  for (int z = voxel.z - 1; z <= voxel.z + 1; ++z)
    for (int y = voxel.y - 1; y <= voxel.y + 1; ++y)
      for (int x = voxel.x - 1; x <= voxel.x + 1; ++x, ++bit)
        if (grid_.isFree({x, y, z})) free |= 1U << bit;
  return free;
}

std::optional<VoxelPath> VoxelSearch::plan(const VoxelIndex& start, const VoxelIndex& goal) {
  expansions_ = 0;
  if (!grid_.isFree(start) || !grid_.isFree(goal)) return std::nullopt;
  ++search_;
  std::priority_queue<OpenVoxel> open;
  nodeAt(start) = {0, search_, -1, false};
  open.push({octileCost(start, goal), 0, start});
  while (!open.empty()) {
    const VoxelIndex here = open.top().voxel;
    open.pop();
    Node& node = nodeAt(here);
    if (node.closed) continue;
    node.closed = true;
    if (here == goal) break;
    ++expansions_;
    const std::uint32_t free = freeAround(here);
    for (int i = 0; i < kMoves; ++i) {
      const Move& move = kMove[static_cast<std::size_t>(i)];
      if ((free & move.needs) != move.needs) continue;
      const VoxelIndex to{here.x + move.dx, here.y + move.dy, here.z + move.dz};
      const std::int64_t cost = node.cost + move.cost;
      Node& next = nodeAt(to);
      if (next.search == search_ && (next.closed || next.cost <= cost)) continue;
      next = {cost, search_, static_cast<std::int8_t>(i), false};
      open.push({cost + octileCost(to, goal), cost, to});
    }
  }
  const Node& last = nodeAt(goal);
  if (last.search != search_ || !last.closed) return std::nullopt;
  VoxelPath path;
  for (VoxelIndex at = goal;;) {
    path.voxels.push_back(at);
    const int step = nodeAt(at).step;
    if (step < 0) break;
    const Move& move = kMove[static_cast<std::size_t>(step)];
    path.length += std::sqrt(static_cast<double>(move.axes));
    at = {at.x - move.dx, at.y - move.dy, at.z - move.dz};
  }
  std::reverse(path.voxels.begin(), path.voxels.end());
  return path;
}

}  // namespace swiftlet::planning
