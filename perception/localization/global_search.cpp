#include "perception/localization/global_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/check.hpp"
#include "perception/localization/block_queue.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;

/// More places than this are not kept, as the pose is ambiguous anyway (measured: docs/decisions/localization.md#019).
constexpr int kMaxPlaces = 400;

/// Windows are read 16 bytes at a time and two rows at once; the last read may extend past the array.
constexpr std::size_t kSearchOverread = 64;
/// Points farther than this from the vehicle are not used: they move too much from one searched direction to the next.
constexpr double kMaxReach_m = 25.0;

std::size_t indexOf(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

}  // namespace

GlobalSearch::GlobalSearch(std::shared_ptr<const MapField> map, const GlobalSearchConfig& config,
                           Instructions instructions)
    : map_(std::move(map)), config_(config), instructions_(instructions) {
  layOut();
  buildFinestLevel();
  buildCoarserLevels();
}

void GlobalSearch::layOut() {
  cell_m_ = std::max(config_.cell_m, map_->resolution_m());
  const Eigen::Vector2d size_m = map_->high_m() - map_->low_m();
  reach_m_ = std::min(kMaxReach_m, size_m.norm() + cell_m_);
  constexpr int kBlock = 1 << kTopLevel;
  const auto wholeBlocks = [](double cells) {
    return (static_cast<int>(std::ceil(cells)) + kBlock - 1) / kBlock * kBlock;
  };
  columns_ = wholeBlocks(std::max(size_m.x(), cell_m_) / cell_m_);
  rows_ = wholeBlocks(std::max(size_m.y(), cell_m_) / cell_m_);
  border_ = wholeBlocks(reach_m_ / cell_m_ + 2.0);
  // Windows of sums are 16 blocks wide and may begin at the last block.
  width_ = columns_ + 2 * border_ + kWindowColumns * kBlock;
  height_ = rows_ + 2 * border_ + 2 * kBlock;
}

void GlobalSearch::buildFinestLevel() {
  std::vector<std::uint8_t>& finest = fields_[0];
  finest.assign(indexOf(0, height_, width_) + kSearchOverread, 0);
  free_[0].assign(indexOf(0, rows_, columns_), 0);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Eigen::Vector2d center = map_->low_m() + Eigen::Vector2d(x - border_ + 0.5, y - border_ + 0.5) * cell_m_;
      const MapField::Place place = map_->at(center);
      const double value = beamValue(place.wall_distance_m, config_.sigma_m, MapField::kRandomShare);
      finest[indexOf(x, y, width_)] = static_cast<std::uint8_t>(
          std::lround(255.0 * (place.known ? value : std::max(value, MapField::kUnknownValue))));
      const int column = x - border_, row = y - border_;
      if (column >= 0 && row >= 0 && column < columns_ && row < rows_)
        free_[0][indexOf(column, row, columns_)] = place.free ? 1 : 0;
    }
  }
}

/// A value of level k bounds the value of a point anywhere in its block when it is moved by 0 .. 2^k - 1 positions, as
/// in LikelihoodField.
void GlobalSearch::buildCoarserLevels() {
  for (int k = 1; k < kLevels; ++k) {
    const std::vector<std::uint8_t>& fine = fields_[static_cast<std::size_t>(k - 1)];
    std::vector<std::uint8_t>& coarse = fields_[static_cast<std::size_t>(k)];
    const int fine_width = width_ >> (k - 1), fine_height = height_ >> (k - 1);
    const int coarse_width = width_ >> k, coarse_height = height_ >> k;
    coarse.assign(indexOf(0, coarse_height, coarse_width) + kSearchOverread, 0);
    for (int y = 0; y < coarse_height; ++y)
      for (int x = 0; x < coarse_width; ++x) {
        std::uint8_t most = 0;
        for (int dy = 0; dy < 3; ++dy)
          for (int dx = 0; dx < 3; ++dx)
            most = std::max(
                most,
                fine[indexOf(std::min(2 * x + dx, fine_width - 1), std::min(2 * y + dy, fine_height - 1), fine_width)]);
        coarse[indexOf(x, y, coarse_width)] = most;
      }
    std::vector<std::uint8_t>& free = free_[static_cast<std::size_t>(k)];
    free.assign(indexOf(0, rows_ >> k, columns_ >> k), 0);
    for (int y = 0; y < rows_ >> (k - 1); ++y)
      for (int x = 0; x < columns_ >> (k - 1); ++x)
        free[indexOf(x >> 1, y >> 1, columns_ >> k)] |=
            free_[static_cast<std::size_t>(k - 1)][indexOf(x, y, columns_ >> (k - 1))];
  }
}

bool GlobalSearch::isFree(int level, int x, int y) const {
  return free_[static_cast<std::size_t>(level)][indexOf(x, y, columns_ >> level)] != 0;
}

/// The search for one set of points, best first: the block of poses with the highest bound is split until single poses
/// are reached. Poses are reached in descending order of score, so no later place is better than an earlier one.
class GlobalSearch::Descent {
 public:
  struct Place {
    std::int32_t score = 0, x = 0, y = 0, direction = 0;
  };

  /// Takes points in the vehicle's frame. Poses that score `least` or less are ignored, and so are poses that score
  /// `margin` or more below the best.
  Descent(const GlobalSearch& search, const std::vector<float>& x_m, const std::vector<float>& y_m, std::int32_t least,
          std::int32_t margin);

  void run();
  const std::vector<Place>& places() const { return places_; }  ///< Best first.
  bool complete() const { return complete_; }
  double step_rad() const { return step_rad_; }

 private:
  struct Direction {
    std::vector<std::int32_t> x_cells, y_cells;
    std::array<std::vector<std::int32_t>, kLevels> offsets;
  };

  const std::vector<std::int32_t>& offsetsAt(int direction, int level);
  std::vector<PoseBlock> topBlocks();
  void keepTheBest(std::vector<PoseBlock>& blocks);
  std::array<PoseBlock, 4> childrenOf(const PoseBlock& block);
  std::int32_t scoreWithin(PoseBlock block);
  void divide(const PoseBlock& block, BlockQueue& queue);
  bool covered(const PoseBlock& block) const;
  int apart(int a, int b) const;
  /// Poses that score no more than this are ignored.
  std::int32_t floor() const { return std::max(least_, best_ - margin_); }

  const GlobalSearch& search_;
  std::int32_t least_, margin_;
  std::int32_t best_ = 0;  // Best score so far.
  double step_rad_ = 0.0;
  int distinct_cells_ = 0, distinct_directions_ = 0;
  std::vector<Direction> directions_;
  std::int32_t forgotten_ = 0;  // Highest bound among the blocks dropped for lack of memory.
  std::vector<Place> places_;
  bool complete_ = true;
};

GlobalSearch::Descent::Descent(const GlobalSearch& search, const std::vector<float>& x_m, const std::vector<float>& y_m,
                               std::int32_t least, std::int32_t margin)
    : search_(search), least_(least), margin_(margin) {
  const GlobalSearchConfig& config = search.config_;
  const auto count = static_cast<int>(std::ceil(2.0 * std::numbers::pi * config.lever_m / (2.0 * config.sigma_m)));
  step_rad_ = 2.0 * std::numbers::pi / count;
  distinct_cells_ = static_cast<int>(config.distinct_m / search.cell_m_);
  distinct_directions_ = static_cast<int>(config.distinct_deg * kRadPerDeg / step_rad_);
  const auto scale = static_cast<float>(1.0 / search.cell_m_);
  directions_.resize(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    Direction& d = directions_[static_cast<std::size_t>(k)];
    d.x_cells.resize(x_m.size());
    d.y_cells.resize(x_m.size());
    const double yaw_rad = k * step_rad_;
    const float middle = 0.5F + static_cast<float>(search.border_);
    transformToCells(x_m, y_m, static_cast<float>(std::cos(yaw_rad)) * scale,
                     static_cast<float>(std::sin(yaw_rad)) * scale, middle, middle, d.x_cells, d.y_cells);
  }
}

const std::vector<std::int32_t>& GlobalSearch::Descent::offsetsAt(int direction, int level) {
  Direction& d = directions_[static_cast<std::size_t>(direction)];
  std::vector<std::int32_t>& offsets = d.offsets[static_cast<std::size_t>(level)];
  if (!offsets.empty()) return offsets;
  offsets.resize(d.x_cells.size());
  for (std::size_t i = 0; i < offsets.size(); ++i)
    offsets[i] = (d.y_cells[i] >> level) * (search_.width_ >> level) + (d.x_cells[i] >> level);
  return offsets;
}

void GlobalSearch::Descent::run() {
  BlockQueue queue(topBlocks());
  int divided = 0;
  while (!queue.empty()) {
    // A dropped block may contain a better pose than all that remain.
    if (queue.bound() <= std::max(floor(), forgotten_)) break;
    const PoseBlock block = queue.take();
    if (covered(block)) continue;
    if (block.level > 0) {
      complete_ = ++divided <= search_.config_.max_blocks;
      if (!complete_) return;
      divide(block, queue);
      continue;
    }
    best_ = std::max<std::int32_t>(best_, block.bound);
    places_.push_back({block.bound, block.x, block.y, block.direction});
    complete_ = static_cast<int>(places_.size()) < kMaxPlaces;
    if (!complete_) return;
  }
  complete_ = forgotten_ <= floor();
}

/// The coarsest blocks that may contain a place, in no order.
std::vector<PoseBlock> GlobalSearch::Descent::topBlocks() {
  const GlobalSearch& s = search_;
  std::vector<PoseBlock> blocks;
  const int blocks_x = s.columns_ >> kTopLevel, blocks_y = s.rows_ >> kTopLevel, stride = s.width_ >> kTopLevel;
  const auto room = 2 * static_cast<std::size_t>(s.config_.max_blocks);
  std::vector<std::uint16_t> sums(indexOf(0, blocks_y, kWindowColumns));
  std::int32_t least = floor(), highest = 0;
  for (int k = 0; k < static_cast<int>(directions_.size()); ++k) {
    const std::vector<std::int32_t>& offsets = offsetsAt(k, kTopLevel);
    for (int x0 = 0; x0 < blocks_x; x0 += kWindowColumns) {
      sumWindows(s.instructions_, s.fields_[kTopLevel].data() + x0, stride, offsets, blocks_y, sums.data());
      for (int y = 0; y < blocks_y; ++y)
        for (int x = x0; x < std::min(blocks_x, x0 + kWindowColumns); ++x) {
          const std::uint16_t bound = sums[windowIndex(x - x0, y)];
          if (bound <= least || !s.isFree(kTopLevel, x, y)) continue;
          blocks.push_back({bound, static_cast<std::uint16_t>(k), kTopLevel, x, y});
          if (bound <= highest) continue;
          // A good pose found early lets more blocks be discarded.
          highest = bound;
          best_ = std::max(best_, scoreWithin(blocks.back()));
          least = std::max(floor(), forgotten_);
        }
      if (blocks.size() > room) {
        keepTheBest(blocks);
        least = std::max(floor(), forgotten_);
      }
    }
  }
  std::erase_if(blocks, [&](const PoseBlock& block) { return block.bound <= least; });
  return blocks;
}

/// Keeps as many blocks as can ever be divided: a large map has hundreds of millions of blocks.
void GlobalSearch::Descent::keepTheBest(std::vector<PoseBlock>& blocks) {
  std::vector<std::size_t> counts(std::numeric_limits<std::uint16_t>::max() + 1);
  for (const PoseBlock& block : blocks) ++counts[block.bound];
  auto bound = static_cast<std::int32_t>(counts.size());
  for (std::size_t kept = 0; kept <= static_cast<std::size_t>(search_.config_.max_blocks);)
    kept += counts[static_cast<std::size_t>(--bound)];
  forgotten_ = bound;
  std::erase_if(blocks, [&](const PoseBlock& block) { return block.bound <= forgotten_; });
}

int GlobalSearch::Descent::apart(int a, int b) const {
  const int count = static_cast<int>(directions_.size()), off = std::abs(a - b);
  return std::min(off, count - off);
}

/// Non-maximum suppression: whether all poses of the block are too near to a place already found to be distinct from
/// it. Places found earlier score at least as high.
bool GlobalSearch::Descent::covered(const PoseBlock& block) const {
  const int last = (1 << block.level) - 1, x = block.x << block.level, y = block.y << block.level;
  return std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
    return x >= place.x - distinct_cells_ && x + last <= place.x + distinct_cells_ && y >= place.y - distinct_cells_ &&
           y + last <= place.y + distinct_cells_ && apart(place.direction, block.direction) <= distinct_directions_;
  });
}

/// Children without a free position get the bound 0.
std::array<PoseBlock, 4> GlobalSearch::Descent::childrenOf(const PoseBlock& block) {
  const int finer = block.level - 1, stride = search_.width_ >> finer;
  std::array<std::uint16_t, std::size_t{2} * kWindowColumns> sums;
  sumWindows(search_.instructions_,
             search_.fields_[static_cast<std::size_t>(finer)].data() + indexOf(2 * block.x, 2 * block.y, stride),
             stride, offsetsAt(block.direction, finer), 2, sums.data());
  std::array<PoseBlock, 4> children;
  for (int i = 0; i < 4; ++i) {
    const int dx = i % 2, dy = i / 2, x = 2 * block.x + dx, y = 2 * block.y + dy;
    const std::uint16_t bound = search_.isFree(finer, x, y) ? sums[windowIndex(dx, dy)] : std::uint16_t{0};
    children[static_cast<std::size_t>(i)] = {bound, block.direction, finer, x, y};
  }
  return children;
}

/// Greedy descent: the score of a good pose of the block, which need not be its best.
std::int32_t GlobalSearch::Descent::scoreWithin(PoseBlock block) {
  while (block.level > 0) {
    const std::array<PoseBlock, 4> children = childrenOf(block);
    block = *std::max_element(children.begin(), children.end());
  }
  return block.bound;
}

void GlobalSearch::Descent::divide(const PoseBlock& block, BlockQueue& queue) {
  for (const PoseBlock& child : childrenOf(block))
    if (child.bound > floor()) queue.push(child);
}

GlobalSearchResult GlobalSearch::search(const std::vector<Eigen::Vector2f>& points_m, double margin) const {
  SWIFTLET_CHECK(points_m.size() <= kMaxWindowPoints, points_m.size());
  std::vector<float> x_m, y_m;
  for (const Eigen::Vector2f& p : points_m) {
    if (!(p.norm() < static_cast<float>(reach_m_))) continue;
    x_m.push_back(p.x());
    y_m.push_back(p.y());
  }
  GlobalSearchResult result;
  if (x_m.empty()) return result;
  const double top = 255.0 * static_cast<double>(x_m.size());
  Descent descent(*this, x_m, y_m, static_cast<std::int32_t>(config_.least_fit * top),
                  static_cast<std::int32_t>(margin * top));
  descent.run();
  for (const Descent::Place& place : descent.places()) {
    const Eigen::Vector2d at = map_->low_m() + Eigen::Vector2d(place.x + 0.5, place.y + 0.5) * cell_m_;
    result.places.push_back(
        {{at.x(), at.y(), common::wrapAngle(place.direction * descent.step_rad())}, place.score / top});
  }
  result.complete = descent.complete();
  return result;
}

}  // namespace swiftlet::perception
