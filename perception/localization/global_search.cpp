#include "perception/localization/global_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/check.hpp"
#include "common/validation.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;

/// Windows are read 16 bytes at a time and two rows at once; the last may reach beyond the array.
constexpr std::size_t kOverread = 64;
/// Points farther than this from the vehicle move too much between two directions to be of use.
constexpr double kMaxReach_m = 25.0;

std::size_t indexOf(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

}  // namespace

void GlobalSearchConfig::describe(common::config::Fields& fields) {
  fields("cell_m", cell_m, "Of the positions searched.");
  fields("sigma_m", sigma_m, "Of the likelihood field.");
  fields("random_share", random_share, "Density of beams that end anywhere.");
  fields("unknown_value", unknown_value, "What an unknown cell counts, of the value on a wall.");
  fields("lever_m", lever_m, "Points at this distance move by 2 sigma from one direction to the next.");
  fields("least_fit", least_fit, "Mean value below which a place does not fit.");
  fields("distinct_m", distinct_m, "Places nearer than this are one,");
  fields("distinct_deg", distinct_deg, "if they are turned less than this.");
  fields("max_places", max_places, "More are not told apart.");
  fields("max_blocks", max_blocks, "Blocks of poses after which the search is given up.");
}

std::vector<std::string> GlobalSearchConfig::validate() const {
  return common::Validation()
      .within("cell_m", cell_m, 0.01, 1)
      .within("sigma_m", sigma_m, 0.01, 2)
      .within("random_share", random_share, 0.001, 0.999)
      .within("unknown_value", unknown_value, 0, 1)
      .within("lever_m", lever_m, 0.5, 100)
      .within("least_fit", least_fit, 0, 1)
      .within("distinct_m", distinct_m, 0.05, 10)
      .within("distinct_deg", distinct_deg, 1, 180)
      .within("max_places", max_places, 1, 1000)
      .within("max_blocks", max_blocks, 1000, 1e9)
      .problems();
}

GlobalSearch::GlobalSearch(std::shared_ptr<const MapField> map, const GlobalSearchConfig& config,
                           Instructions instructions)
    : map_(std::move(map)), config_(config), instructions_(instructions) {
  buildLevels(config);
}

/// Level k bounds what a point finds that is moved by 0 .. 2^k - 1 positions from any place in a block, as in
/// LikelihoodField.
void GlobalSearch::buildLevels(const GlobalSearchConfig& config) {
  cell_m_ = std::max(config.cell_m, map_->resolution_m());
  const Eigen::Vector2d size_m = map_->high_m() - map_->low_m();
  reach_m_ = std::min(kMaxReach_m, size_m.norm() + cell_m_);
  constexpr int kBlock = 1 << kTopLevel;
  const auto wholeBlocks = [](double cells) {
    return (static_cast<int>(std::ceil(cells)) + kBlock - 1) / kBlock * kBlock;
  };
  columns_ = wholeBlocks(std::max(size_m.x(), cell_m_) / cell_m_);
  rows_ = wholeBlocks(std::max(size_m.y(), cell_m_) / cell_m_);
  border_ = wholeBlocks(reach_m_ / cell_m_ + 2.0);
  // Windows of sums are 16 blocks wide; they may begin at the last block.
  width_ = columns_ + 2 * border_ + kWindowColumns * kBlock;
  height_ = rows_ + 2 * border_ + 2 * kBlock;

  std::vector<std::uint8_t>& finest = fields_[0];
  finest.assign(indexOf(0, height_, width_) + kOverread, 0);
  free_[0].assign(indexOf(0, rows_, columns_), 0);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Eigen::Vector2d center = map_->low_m() + Eigen::Vector2d(x - border_ + 0.5, y - border_ + 0.5) * cell_m_;
      const MapField::Place place = map_->at(center);
      const double value = beamValue(place.wall_distance_m, config.sigma_m, config.random_share);
      finest[indexOf(x, y, width_)] =
          static_cast<std::uint8_t>(std::lround(255.0 * (place.known ? value : std::max(value, config.unknown_value))));
      const int column = x - border_, row = y - border_;
      if (column >= 0 && row >= 0 && column < columns_ && row < rows_)
        free_[0][indexOf(column, row, columns_)] = place.free ? 1 : 0;
    }
  }
  for (int k = 1; k < kLevels; ++k) {
    const std::vector<std::uint8_t>& fine = fields_[static_cast<std::size_t>(k - 1)];
    std::vector<std::uint8_t>& coarse = fields_[static_cast<std::size_t>(k)];
    const int fine_width = width_ >> (k - 1), fine_height = height_ >> (k - 1);
    const int coarse_width = width_ >> k, coarse_height = height_ >> k;
    coarse.assign(indexOf(0, coarse_height, coarse_width) + kOverread, 0);
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

const std::vector<std::int32_t>& GlobalSearch::offsetsAt(int direction, int level) {
  Direction& d = directions_[static_cast<std::size_t>(direction)];
  std::vector<std::int32_t>& offsets = d.offsets[static_cast<std::size_t>(level)];
  if (!offsets.empty()) return offsets;
  offsets.resize(d.x_cells.size());
  for (std::size_t i = 0; i < offsets.size(); ++i)
    offsets[i] = (d.y_cells[i] >> level) * (width_ >> level) + (d.x_cells[i] >> level);
  return offsets;
}

/// The least score that is still of interest.
std::int32_t GlobalSearch::floor() const {
  std::int32_t floor = least_;
  if (!places_.empty()) floor = std::max(floor, places_.front().score - margin_);
  if (static_cast<int>(places_.size()) >= config_.max_places) floor = std::max(floor, places_.back().score);
  return floor;
}

GlobalSearchResult GlobalSearch::search(const std::vector<Eigen::Vector2f>& points_m, double margin) {
  SWIFTLET_CHECK(points_m.size() <= kMaxWindowPoints, points_m.size());
  std::vector<float> x_m, y_m;
  for (const Eigen::Vector2f& p : points_m) {
    if (!(p.norm() < static_cast<float>(reach_m_))) continue;
    x_m.push_back(p.x());
    y_m.push_back(p.y());
  }
  GlobalSearchResult result;
  if (x_m.empty() || map_->freeCells_m().empty()) return result;
  const double top = 255.0 * static_cast<double>(x_m.size());
  least_ = static_cast<std::int32_t>(config_.least_fit * top);
  margin_ = static_cast<std::int32_t>(margin * top);
  const auto count = static_cast<int>(std::ceil(2.0 * std::numbers::pi * config_.lever_m / (2.0 * config_.sigma_m)));
  const double step_rad = 2.0 * std::numbers::pi / count;
  distinct_cells_ = static_cast<int>(config_.distinct_m / cell_m_);
  distinct_directions_ = static_cast<int>(config_.distinct_deg * kRadPerDeg / step_rad);
  const auto scale = static_cast<float>(1.0 / cell_m_);
  directions_.resize(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    Direction& d = directions_[static_cast<std::size_t>(k)];
    d.x_cells.resize(x_m.size());
    d.y_cells.resize(x_m.size());
    for (std::vector<std::int32_t>& offsets : d.offsets) offsets.clear();
    const double yaw_rad = k * step_rad;
    const float middle = 0.5F + static_cast<float>(border_);
    transformToCells(x_m, y_m, static_cast<float>(std::cos(yaw_rad)) * scale,
                     static_cast<float>(std::sin(yaw_rad)) * scale, middle, middle, d.x_cells, d.y_cells);
  }

  places_.clear();
  blocks_ = 0;
  complete_ = true;
  boundTopBlocks(least_);
  for (const std::uint32_t next : order_) {
    const Node& node = nodes_[next];
    if (node.bound <= floor()) break;
    descend(node, kTopLevel);
    if (!complete_) break;
  }
  complete_ &= static_cast<int>(places_.size()) < config_.max_places;
  for (const Place& place : places_) {
    const Eigen::Vector2d at = map_->low_m() + Eigen::Vector2d(place.x + 0.5, place.y + 0.5) * cell_m_;
    result.places.push_back({{at.x(), at.y(), common::wrapAngle(place.direction * step_rad)}, place.score / top});
  }
  result.complete = complete_;
  return result;
}

void GlobalSearch::boundTopBlocks(std::int32_t floor) {
  const int blocks_x = columns_ >> kTopLevel, blocks_y = rows_ >> kTopLevel, stride = width_ >> kTopLevel;
  std::vector<std::uint16_t> sums(indexOf(0, blocks_y, kWindowColumns));
  nodes_.clear();
  for (int k = 0; k < static_cast<int>(directions_.size()); ++k) {
    const std::vector<std::int32_t>& offsets = offsetsAt(k, kTopLevel);
    for (int x0 = 0; x0 < blocks_x; x0 += kWindowColumns) {
      sumWindows(instructions_, fields_[kTopLevel].data() + x0, stride, offsets, blocks_y, sums.data());
      for (int y = 0; y < blocks_y; ++y)
        for (int x = x0; x < std::min(blocks_x, x0 + kWindowColumns); ++x) {
          const std::int32_t bound = sums[windowIndex(x - x0, y)];
          if (bound > floor && isFree(kTopLevel, x, y)) nodes_.push_back({bound, x, y, k});
        }
    }
  }
  sortByBound();
}

/// By counting: the bounds are small integers, and of a large map there are hundreds of thousands of nodes.
void GlobalSearch::sortByBound() {
  std::int32_t highest = 0;
  for (const Node& node : nodes_) highest = std::max(highest, node.bound);
  std::vector<std::uint32_t> begins(static_cast<std::size_t>(highest) + 2);
  for (const Node& node : nodes_) ++begins[static_cast<std::size_t>(highest - node.bound) + 1];
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  order_.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    order_[begins[static_cast<std::size_t>(highest - nodes_[i].bound)]++] = static_cast<std::uint32_t>(i);
}

int GlobalSearch::apart(int a, int b) const {
  const int count = static_cast<int>(directions_.size()), off = std::abs(a - b);
  return std::min(off, count - off);
}

/// Whether the whole block belongs to a place that is better than its bound.
bool GlobalSearch::covered(const Node& node, int level) const {
  const int last = (1 << level) - 1, x = node.x << level, y = node.y << level;
  return std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
    return place.score >= node.bound && apart(place.direction, node.direction) <= distinct_directions_ &&
           x >= place.x - distinct_cells_ && x + last <= place.x + distinct_cells_ && y >= place.y - distinct_cells_ &&
           y + last <= place.y + distinct_cells_;
  });
}

void GlobalSearch::descend(const Node& node, int level) {
  if (node.bound <= floor() || covered(node, level)) return;
  if (level == 0) {
    take(node);
    return;
  }
  if (++blocks_ > config_.max_blocks) {
    complete_ = false;
    return;
  }
  const int finer = level - 1, stride = width_ >> finer;
  std::array<std::uint16_t, std::size_t{2} * kWindowColumns> sums;
  sumWindows(instructions_, fields_[static_cast<std::size_t>(finer)].data() + indexOf(2 * node.x, 2 * node.y, stride),
             stride, offsetsAt(node.direction, finer), 2, sums.data());
  std::array<Node, 4> children;
  for (int i = 0; i < 4; ++i) {
    const int dx = i % 2, dy = i / 2;
    children[static_cast<std::size_t>(i)] = {sums[windowIndex(dx, dy)], 2 * node.x + dx, 2 * node.y + dy,
                                             node.direction};
  }
  std::stable_sort(children.begin(), children.end(), [](const Node& a, const Node& b) { return a.bound > b.bound; });
  for (const Node& child : children)
    if (isFree(finer, child.x, child.y)) descend(child, finer);
}

/// A pose that fits: a place of its own, or a better pose of one that is known.
void GlobalSearch::take(const Node& node) {
  const auto same = [&](const Place& place) {
    return apart(place.direction, node.direction) <= distinct_directions_ &&
           std::abs(place.x - node.x) <= distinct_cells_ && std::abs(place.y - node.y) <= distinct_cells_;
  };
  if (std::any_of(places_.begin(), places_.end(),
                  [&](const Place& place) { return place.score >= node.bound && same(place); }))
    return;
  std::erase_if(places_, same);
  const Place place{node.bound, node.x, node.y, node.direction};
  places_.insert(std::upper_bound(places_.begin(), places_.end(), place,
                                  [](const Place& a, const Place& b) { return a.score > b.score; }),
                 place);
  if (static_cast<int>(places_.size()) > config_.max_places) places_.pop_back();
  const std::int32_t least = places_.front().score - margin_;
  std::erase_if(places_, [&](const Place& p) { return p.score < least; });
}

}  // namespace swiftlet::perception
