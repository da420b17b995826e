#include "perception/scan_matching/branch_and_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

#include "common/check.hpp"

namespace swiftlet::perception {
namespace {

/// Blocks per side at the coarsest level. More blocks make the first pass slower; fewer make its bounds looser.
constexpr int kTopBlocks = 8;

int topLevelFor(int translations) {
  int level = 0;
  while (level + 1 < LikelihoodField::kLevels && ((translations - 1) >> level) + 1 > kTopBlocks) ++level;
  return level;
}

/// Squared distance, in steps, from the middle of the grid to the nearest pose of a block of 2^level translations per
/// side.
double leastDistance2(const PoseGrid& grid, int x, int y, int level) {
  const double middle = 0.5 * (grid.translations - 1), size = (1 << level) - 1;
  const auto gap = [&](int first) { return std::max({0.0, first - middle, middle - first - size}); };
  const double dx = gap(x), dy = gap(y);
  return dx * dx + dy * dy;
}

}  // namespace

void BranchAndBound::allCellsAt(const LikelihoodField& field, std::span<const float> x_m, std::span<const float> y_m,
                                double yaw_rad, double shift_x_m, double shift_y_m, std::vector<std::int32_t>& x_cells,
                                std::vector<std::int32_t>& y_cells) {
  const double scale = 1.0 / field.resolution_m();
  x_cells.resize(x_m.size());
  y_cells.resize(x_m.size());
  transformToCells(x_m, y_m, static_cast<float>(std::cos(yaw_rad) * scale),
                   static_cast<float>(std::sin(yaw_rad) * scale),
                   static_cast<float>(shift_x_m * scale - field.beginX()),
                   static_cast<float>(shift_y_m * scale - field.beginY()), x_cells, y_cells);
}

void BranchAndBound::cellsAt(const LikelihoodField& field, std::span<const float> x_m, std::span<const float> y_m,
                             double yaw_rad, double shift_x_m, double shift_y_m, int border,
                             std::vector<std::int32_t>& x_cells, std::vector<std::int32_t>& y_cells) {
  allCellsAt(field, x_m, y_m, yaw_rad, shift_x_m, shift_y_m, x_cells, y_cells);
  // Branchless, because most points are kept. The cast to unsigned makes negative cells large, so they fail the
  // comparison.
  const auto end_x = static_cast<std::uint32_t>(std::max(field.width() - border, 0));
  const auto end_y = static_cast<std::uint32_t>(std::max(field.height() - border, 0));
  std::size_t kept = 0, i = 0;
#if defined(__x86_64__)
  // Four points at a time, until one of the four is outside.
  const auto load = [](const std::int32_t& cell) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(&cell)); };
  const auto outside = [](__m128i cells, __m128i last) { return _mm_or_si128(cells, _mm_sub_epi32(last, cells)); };
  const __m128i last_x = _mm_set1_epi32(static_cast<std::int32_t>(end_x) - 1);
  const __m128i last_y = _mm_set1_epi32(static_cast<std::int32_t>(end_y) - 1);
  for (; i + 4 <= x_cells.size(); i += 4) {
    const __m128i signs = _mm_or_si128(outside(load(x_cells[i]), last_x), outside(load(y_cells[i]), last_y));
    if (_mm_movemask_ps(_mm_castsi128_ps(signs)) != 0) break;
  }
  kept = i;
#endif
  for (; i < x_cells.size(); ++i) {
    const std::int32_t x = x_cells[i], y = y_cells[i];
    x_cells[kept] = x;
    y_cells[kept] = y;
    kept += static_cast<std::size_t>(static_cast<std::uint32_t>(x) < end_x) &
            static_cast<std::size_t>(static_cast<std::uint32_t>(y) < end_y);
  }
  x_cells.resize(kept);
  y_cells.resize(kept);
}

int BranchAndBound::leastPenalty(const GuessPenalty& penalty, const PoseGrid& grid, int x, int y, int rotation,
                                 int level) {
  if (penalty.greatest == 0) return 0;
  return penalty.at(leastDistance2(grid, x, y, level), rotation - 0.5 * (grid.rotations - 1));
}

const std::vector<std::int32_t>& BranchAndBound::offsetsAt(const LikelihoodField& field, int rotation, int level) {
  RotatedCells& r = rotations_[static_cast<std::size_t>(rotation)];
  std::vector<std::int32_t>& offsets = r.offsets[static_cast<std::size_t>(level)];
  if (r.has_offsets[static_cast<std::size_t>(level)]) return offsets;
  const int stride = field.level(level).stride;
  offsets.resize(r.x_cells.size());
  for (std::size_t i = 0; i < offsets.size(); ++i)
    offsets[i] = (r.y_cells[i] >> level) * stride + (r.x_cells[i] >> level);
  r.has_offsets[static_cast<std::size_t>(level)] = true;
  return offsets;
}

BestPose BranchAndBound::search(LikelihoodField& field, const std::vector<Eigen::Vector2f>& points_m,
                                const PoseGrid& grid, const GuessPenalty& penalty, int floor) {
  excluded_ = nullptr;
  penalty_ = penalty;
  BestPose least;
  least.score = floor;
  return searchFrom(field, points_m, grid, least);
}

BestPose BranchAndBound::searchElsewhere(LikelihoodField& field, const std::vector<Eigen::Vector2f>& points_m,
                                         const PoseGrid& grid, const ExcludedPoses& excluded, int floor) {
  excluded_ = &excluded;
  steps_per_turn_ = static_cast<int>(std::lround(2.0 * std::numbers::pi / grid.step_yaw_rad));
  penalty_ = {};
  BestPose least;
  least.score = floor;
  const BestPose best = searchFrom(field, points_m, grid, least);
  excluded_ = nullptr;
  return best;
}

BestPose BranchAndBound::searchFrom(LikelihoodField& field, const std::vector<Eigen::Vector2f>& points_m,
                                    const PoseGrid& grid, BestPose best) {
  if (points_m.empty() || field.empty() || grid.rotations <= 0 || grid.translations <= 0) return best;
  SWIFTLET_CHECK(grid.rotations < INT16_MAX && grid.translations < INT16_MAX, grid.rotations, grid.translations);
  const int top = topLevelFor(grid.translations);
  // A block of the top level may begin inside the window and end outside it.
  const int border = grid.translations + (2 << top) + kWindowColumns;
  field.prepare(top, border);

  x_m_.clear();
  y_m_.clear();
  for (const Eigen::Vector2f& p : points_m) {
    x_m_.push_back(p.x());
    y_m_.push_back(p.y());
  }
  if (rotations_.size() < static_cast<std::size_t>(grid.rotations))
    rotations_.resize(static_cast<std::size_t>(grid.rotations));

  const int blocks = ((grid.translations - 1) >> top) + 1;
  boundTopLevel(field, grid, top, blocks, border);
  const auto nodeAt = [&](std::size_t i) {
    const auto index = static_cast<std::int32_t>(i);
    const std::int32_t row = index / blocks;
    return SearchNode{bounds_[i], index, static_cast<std::int16_t>(row / blocks),
                      static_cast<std::int16_t>(index % blocks), static_cast<std::int16_t>(row % blocks)};
  };
  const auto greatest = std::max_element(bounds_.begin(), bounds_.end());
  descend(field, nodeAt(static_cast<std::size_t>(greatest - bounds_.begin())), top, grid, best);
  nodes_.clear();
  for (std::size_t i = 0; i < bounds_.size(); ++i)
    if (bounds_[i] > best.score) nodes_.push_back(nodeAt(i));
  // A heap is cheaper than sorting, because most nodes are never examined.
  const auto isWorse = [](const SearchNode& a, const SearchNode& b) { return b.isBetter(a); };
  std::make_heap(nodes_.begin(), nodes_.end(), isWorse);
  while (!nodes_.empty() && nodes_.front().bound > best.score) {
    descend(field, nodes_.front(), top, grid, best);
    std::pop_heap(nodes_.begin(), nodes_.end(), isWorse);
    nodes_.pop_back();
  }
  return best;
}

/// Fills bounds_[(rotation * blocks + y) * blocks + x].
void BranchAndBound::boundTopLevel(const LikelihoodField& field, const PoseGrid& grid, int top, int blocks,
                                   int border) {
  const auto size = static_cast<std::size_t>(blocks);
  block_shares_.resize(size * size);
  auto share = block_shares_.begin();
  for (int y = 0; y < blocks; ++y)
    for (int x = 0; x < blocks; ++x)
      *share++ = penalty_.translationShare(leastDistance2(grid, x << top, y << top, top));

  // sumWindows adds strips of kWindowColumns columns.
  const LikelihoodField::Level level = field.level(top);
  std::vector<std::uint16_t> sums(size * kWindowColumns);
  bounds_.resize(static_cast<std::size_t>(grid.rotations) * size * size);
  for (int k = 0; k < grid.rotations; ++k) {
    RotatedCells& r = rotations_[static_cast<std::size_t>(k)];
    r.has_offsets.fill(false);
    cellsAt(field, x_m_, y_m_, grid.first_yaw_rad + k * grid.step_yaw_rad, grid.first_x_m, grid.first_y_m, border,
            r.x_cells, r.y_cells);
    const std::vector<std::int32_t>& offsets = offsetsAt(field, k, top);
    std::int32_t* out = &bounds_[static_cast<std::size_t>(k) * size * size];
    for (int x0 = 0; x0 < blocks; x0 += kWindowColumns) {
      sumWindows(instructions_, level.cells + x0, level.stride, offsets, blocks, sums.data());
      const int columns = std::min(blocks - x0, kWindowColumns);
      for (int y = 0; y < blocks; ++y)
        for (int x = 0; x < columns; ++x)
          out[static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x0 + x)] = sums[windowIndex(x, y)];
    }
    if (penalty_.greatest == 0) continue;
    const double turned = penalty_.rotationShare(k - 0.5 * (grid.rotations - 1));
    for (std::size_t i = 0; i < size * size; ++i) out[i] -= penalty_.ofShares(block_shares_[i], turned);
  }
}

/// Whether all poses of the block are excluded.
bool BranchAndBound::isExcluded(const SearchNode& node, int level) const {
  const int half = excluded_->half_translation, last = (1 << level) - 1;
  const int x = node.x << level, y = node.y << level;
  const int apart = std::abs(node.rotation - excluded_->center.rotation);
  return std::min(apart, std::abs(steps_per_turn_ - apart)) <= excluded_->half_rotation &&
         x >= excluded_->center.x - half && x + last <= excluded_->center.x + half && y >= excluded_->center.y - half &&
         y + last <= excluded_->center.y + half;
}

void BranchAndBound::descend(const LikelihoodField& field, const SearchNode& node, int level, const PoseGrid& grid,
                             BestPose& best) {
  if (node.bound <= best.score || (excluded_ != nullptr && isExcluded(node, level))) return;
  if (level == 0) {
    best = {node.bound, node.x, node.y, node.rotation};
    return;
  }
  const LikelihoodField::Level finer = field.level(level - 1);
  const std::vector<std::int32_t>& offsets = offsetsAt(field, node.rotation, level - 1);
  std::array<std::uint16_t, 2 * kWindowColumns> sums;
  sumWindows(instructions_, finer.cells + 2 * (static_cast<std::ptrdiff_t>(node.y) * finer.stride + node.x),
             finer.stride, offsets, 2, sums.data());
  std::array<SearchNode, 4> children;
  std::size_t count = 0;
  for (int i = 0; i < 4; ++i) {
    const int dx = i % 2, dy = i / 2;
    const int x = 2 * node.x + dx, y = 2 * node.y + dy;
    const int first_x = x << (level - 1), first_y = y << (level - 1);
    int bound = sums[windowIndex(dx, dy)];
    if (bound <= best.score || first_x >= grid.translations || first_y >= grid.translations) continue;
    bound -= leastPenalty(penalty_, grid, first_x, first_y, node.rotation, level - 1);
    if (bound <= best.score) continue;
    const SearchNode child{bound, i, node.rotation, static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
    std::size_t place = count++;
    for (; place > 0 && child.isBetter(children[place - 1]); --place) children[place] = children[place - 1];
    children[place] = child;
  }
  for (std::size_t i = 0; i < count; ++i) descend(field, children[i], level - 1, grid, best);
}

}  // namespace swiftlet::perception
