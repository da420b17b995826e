#include "mapping3d/voxels/free_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace swiftlet::mapping3d {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;

namespace {

using Word = BitVolume::Word;

/// Counts up to seven bits at each place of a word.
struct BitSums {
  Word ones = 0, twos = 0, fours = 0;
  void add(Word bits) {
    const Word carried = ones & bits;
    ones ^= bits;
    fours |= twos & carried;
    twos ^= carried;
  }
};

/// Sets what is unknown and has free neighbours on most sides, until nothing changes.
void fillSpecks(FreeSpace& space) {
  constexpr int kMostPasses = 32;  // A speck is smaller; an unknown sheet between free voxels goes from its corners.
  BitVolume& free = space.free;
  const bool flat = free.height() == 1;
  const std::size_t words = free.wordsInRow();
  const std::vector<Word> nothing(words, 0);
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const BitVolume before = free;
    const auto rowOf = [&](int y, int z) {
      return before.contains(0, y, z) ? before.row(y, z) : std::span<const Word>(nothing);
    };
    bool changed = false;
    for (int z = 0; z < free.height(); ++z) {
      for (int y = 0; y < free.depth(); ++y) {
        const std::array<std::span<const Word>, 4> beside{rowOf(y - 1, z), rowOf(y + 1, z), rowOf(y, z - 1),
                                                          rowOf(y, z + 1)};
        const std::span<const Word> here = before.row(y, z), measured = space.measured.row(y, z);
        for (std::size_t i = 0; i < words; ++i) {
          BitSums sums;
          for (const std::span<const Word>& row : beside) sums.add(row[i]);
          sums.add(here[i] << 1 | (i > 0 ? here[i - 1] >> (BitVolume::kWordBits - 1) : 0));
          sums.add(here[i] >> 1 | (i + 1 < words ? here[i + 1] << (BitVolume::kWordBits - 1) : 0));
          const Word most = flat ? sums.fours | (sums.twos & sums.ones) : sums.fours;
          const Word filled = most & ~here[i] & ~measured[i];
          if (filled == 0) continue;
          free.row(y, z)[i] |= filled;
          changed = true;
        }
      }
    }
    if (!changed) return;
  }
}

struct VoxelRun {
  int begin, end, y, z;  ///< Voxels along x.
};
struct ConnectedPart {
  std::vector<VoxelRun> runs;
  bool touches_box = false;
};

/// Takes out of a volume what is connected with a voxel by faces.
ConnectedPart takeConnected(BitVolume& volume, VoxelIndex seed) {
  ConnectedPart part;
  std::vector<VoxelIndex> seeds{seed};
  while (!seeds.empty()) {
    const VoxelIndex at = seeds.back();
    seeds.pop_back();
    if (!volume.at(at.x, at.y, at.z)) continue;
    VoxelRun run{at.x, at.x + 1, at.y, at.z};
    while (volume.at(run.begin - 1, at.y, at.z)) --run.begin;
    while (volume.at(run.end, at.y, at.z)) ++run.end;
    for (int x = run.begin; x < run.end; ++x) volume.clear(x, at.y, at.z);
    part.runs.push_back(run);
    part.touches_box = part.touches_box || run.begin == 0 || run.end == volume.width() || at.y == 0 ||
                       at.y == volume.depth() - 1 ||
                       (volume.height() > 1 && (at.z == 0 || at.z == volume.height() - 1));
    for (const auto& [dy, dz] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      bool before = false;
      for (int x = run.begin; x < run.end; ++x) {
        const bool open = volume.at(x, at.y + dy, at.z + dz);
        if (open && !before) seeds.push_back({x, at.y + dy, at.z + dz});
        before = open;
      }
    }
  }
  return part;
}

bool touchesMeasured(const BitVolume& measured, int x, int y, int z) {
  return measured.at(x - 1, y, z) || measured.at(x + 1, y, z) || measured.at(x, y - 1, z) || measured.at(x, y + 1, z) ||
         measured.at(x, y, z - 1) || measured.at(x, y, z + 1);
}

/// Sets what is unknown and enclosed by what is free: a surface in it would have been measured. So are the places of a
/// scanner itself.
void fillEnclosed(FreeSpace& space) {
  BitVolume unknown = space.free;
  for (int z = 0; z < space.free.height(); ++z)
    for (int y = 0; y < space.free.depth(); ++y) {
      const std::span<Word> row = unknown.row(y, z);
      const std::span<const Word> measured = space.measured.row(y, z);
      for (std::size_t i = 0; i < row.size(); ++i) row[i] |= measured[i];
    }
  unknown.invert();
  BitVolume rest = unknown;
  for (int z = 0; z < rest.height(); ++z)
    for (int y = 0; y < rest.depth(); ++y)
      forEachRun(unknown.row(y, z), [&](int begin, int) {
        if (!rest.at(begin, y, z)) return;
        const ConnectedPart part = takeConnected(rest, {begin, y, z});
        bool enclosed = !part.touches_box;
        for (const VoxelRun& run : part.runs) {
          for (int x = run.begin; x < run.end && enclosed; ++x)
            enclosed = !touchesMeasured(space.measured, x, run.y, run.z);
        }
        if (!enclosed) return;
        for (const VoxelRun& run : part.runs)
          for (int x = run.begin; x < run.end; ++x) space.free.set(x, run.y, run.z);
      });
}

FreeSpace emptySpace(const SpaceExtent& extent, double voxel_m) {
  const BitVolume nothing(extent.end.x - extent.begin.x, extent.end.y - extent.begin.y, extent.end.z - extent.begin.z);
  return {nothing, nothing, Eigen::Vector3d(extent.begin.x, extent.begin.y, extent.begin.z) * voxel_m,
          Eigen::Vector3d::Constant(voxel_m), false};
}

void include(SpaceExtent& extent, VoxelIndex first, VoxelIndex last) {
  extent.begin = {std::min(extent.begin.x, first.x), std::min(extent.begin.y, first.y),
                  std::min(extent.begin.z, first.z)};
  extent.end = {std::max(extent.end.x, last.x + 1), std::max(extent.end.y, last.y + 1),
                std::max(extent.end.z, last.z + 1)};
}

}  // namespace

FreeSpace freeSpaceOf(const common::OccupancyGrid& plan, double height_m) {
  const common::CellRect known = knownExtent(plan);
  FreeSpace space{BitVolume(known.width(), known.height(), 1),
                  BitVolume(known.width(), known.height(), 1),
                  {known.begin.x * plan.resolution_m(), known.begin.y * plan.resolution_m(), 0.0},
                  {plan.resolution_m(), plan.resolution_m(), height_m},
                  false};
  plan.forEachCell([&](common::CellIndex cell, common::occupancy::Cell value) {
    if (common::occupancy::isUnknown(value)) return;
    BitVolume& volume = common::occupancy::isFree(value) ? space.free : space.measured;
    volume.set(cell.x - known.begin.x, cell.y - known.begin.y, 0);
  });
  fillSpecks(space);
  fillEnclosed(space);
  return space;
}

SpaceExtent extentOf(const VoxelMap& map) {
  const std::vector<VoxelIndex> blocks = map.blocks();
  if (blocks.empty()) return {};
  const VoxelIndex any = VoxelMap::firstOf(blocks.front());
  SpaceExtent extent{any, any};
  for (const VoxelIndex block : blocks) {
    const VoxelIndex first = VoxelMap::firstOf(block);
    constexpr int kLast = VoxelBlock::kSide - 1;
    include(extent, first, {first.x + kLast, first.y + kLast, first.z + kLast});
  }
  return extent;
}

FreeSpace freeSpaceOf(const VoxelMap& map) {
  const SpaceExtent extent = extentOf(map);
  FreeSpace space = emptySpace(extent, map.resolution_m());
  for (const VoxelIndex block : map.blocks()) {
    const VoxelBlock& voxels = *map.block(block);
    for (int i = 0; i < VoxelBlock::kVoxels; ++i) {
      const std::int8_t evidence = voxels.evidence[static_cast<std::size_t>(i)];
      if (evidence == VoxelBlock::kUnknown) continue;
      const VoxelIndex at = VoxelMap::voxelOf(block, i);
      (evidence > 0 ? space.measured : space.free)
          .set(at.x - extent.begin.x, at.y - extent.begin.y, at.z - extent.begin.z);
    }
  }
  fillSpecks(space);
  fillEnclosed(space);
  return space;
}

double spacingOf_m(const std::vector<common::SurfacePoint>& points, double farthest_m) {
  constexpr std::size_t kDrawn = 2000, kNeighbour = 4;
  constexpr double kShare = 0.95;
  // Squares about the drawn points alone: a dense cloud has thousands of points in each.
  std::unordered_map<VoxelIndex, std::vector<std::size_t>, VoxelMap::Hash> near;
  const VoxelMap cells(farthest_m);
  const std::size_t step = std::max<std::size_t>(1, points.size() / kDrawn);
  const auto cellOf = [&](const common::SurfacePoint& point) { return cells.voxelAt(point.position_m.cast<double>()); };
  std::vector<std::array<float, kNeighbour>> nearest;
  for (std::size_t i = 0; i < points.size(); i += step) {
    const VoxelIndex cell = cellOf(points[i]);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) near[{cell.x + x, cell.y + y, cell.z + z}].push_back(nearest.size());
    nearest.emplace_back().fill(static_cast<float>(farthest_m));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto drawn = near.find(cellOf(points[i]));
    if (drawn == near.end()) continue;
    for (const std::size_t k : drawn->second) {
      std::array<float, kNeighbour>& best = nearest[k];
      const float distance = (points[i].position_m - points[k * step].position_m).norm();
      if (distance == 0.0F || distance >= best.back()) continue;  // Itself, or measured twice.
      best.back() = distance;
      std::sort(best.begin(), best.end());
    }
  }
  if (nearest.empty()) return farthest_m;
  std::vector<float> fourth;
  for (const auto& best : nearest) fourth.push_back(best.back());
  const auto at = fourth.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(fourth.size() - 1));
  std::nth_element(fourth.begin(), at, fourth.end());
  return static_cast<double>(*at);
}

double voxelSideOf_m(double spacing_m) {
  constexpr double kFinest_m = 0.05, kWider = 1.2;
  return std::max(kFinest_m, std::ceil(kWider * spacing_m * 100.0 - 0.1) / 100.0);
}

SpaceExtent extentOf(const std::vector<common::SurfacePoint>& points, double voxel_m, int margin) {
  if (points.empty()) return {};
  Eigen::Vector3f low = points.front().position_m, high = low;
  for (const common::SurfacePoint& point : points) {
    low = low.cwiseMin(point.position_m);
    high = high.cwiseMax(point.position_m);
  }
  const VoxelMap cells(voxel_m);
  const VoxelIndex first = cells.voxelAt(low.cast<double>()), last = cells.voxelAt(high.cast<double>());
  return {{first.x - margin, first.y - margin, first.z - margin},
          {last.x + margin + 1, last.y + margin + 1, last.z + margin + 1}};
}

FreeSpace spaceAround(const std::vector<common::SurfacePoint>& points, double voxel_m, int margin) {
  const SpaceExtent extent = extentOf(points, voxel_m, margin);
  FreeSpace space = emptySpace(extent, voxel_m);
  const VoxelMap cells(voxel_m);
  for (const common::SurfacePoint& point : points) {
    const VoxelIndex at = cells.voxelAt(point.position_m.cast<double>());
    space.measured.set(at.x - extent.begin.x, at.y - extent.begin.y, at.z - extent.begin.z);
  }
  space.open_below = true;
  closeHoles(space, 0);
  return space;
}

void closeHoles(FreeSpace& space, int radius) {
  space.free = space.measured;
  space.free.dilate(radius);
  space.free.invert();
  if (radius == 0) return;
  // Beyond the box is free too. The margin keeps what is measured farther from the box than what is dilated here.
  space.free.dilate(radius);
}

bool keepConnected(FreeSpace& space, VoxelIndex seed) {
  const ConnectedPart part = takeConnected(space.free, seed);
  BitVolume kept(space.free.width(), space.free.depth(), space.free.height());
  for (const VoxelRun& run : part.runs)
    for (int x = run.begin; x < run.end; ++x) kept.set(x, run.y, run.z);
  space.free = std::move(kept);
  return part.touches_box;
}

double measuredFloorShare(const FreeSpace& space) {
  std::size_t columns = 0, measured = 0;
  for (int y = 0; y < space.free.depth(); ++y) {
    for (int x = 0; x < space.free.width(); ++x) {
      int z = 0;
      while (z < space.free.height() && !space.free.at(x, y, z)) ++z;
      if (z == space.free.height()) continue;
      ++columns;
      measured += space.measured.at(x, y, z - 1) ? 1 : 0;
    }
  }
  return columns == 0 ? 0.0 : static_cast<double>(measured) / static_cast<double>(columns);
}

double raiseFloor(FreeSpace& space, double floor_m) {
  const double layers = std::round((floor_m - space.corner_m.z()) / space.voxel_m.z());
  const int below = static_cast<int>(std::clamp(layers, 0.0, static_cast<double>(space.free.height())));
  for (int z = 0; z < below; ++z)
    for (int y = 0; y < space.free.depth(); ++y) std::ranges::fill(space.free.row(y, z), 0);
  space.open_below = false;
  return space.cornerOf_m(0, 0, below).z();
}

double lowerCeiling(FreeSpace& space, double ceiling_m) {
  const double layers = std::round((ceiling_m - space.corner_m.z()) / space.voxel_m.z());
  const int below = static_cast<int>(std::clamp(layers, 0.0, static_cast<double>(space.free.height())));
  for (int z = below; z < space.free.height(); ++z)
    for (int y = 0; y < space.free.depth(); ++y) std::ranges::fill(space.free.row(y, z), 0);
  return space.cornerOf_m(0, 0, below).z();
}

}  // namespace swiftlet::mapping3d
