#include "perception/scan_matching/branch_and_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/check.hpp"

namespace swiftlet::perception {
namespace {

/// Blocks a side at the coarsest level. More makes the first pass dearer, fewer makes its bounds loose.
constexpr int kTopBlocks = 8;

int topLevelFor(int translations) {
  int level = 0;
  while (level + 1 < LikelihoodField::kLevels && ((translations - 1) >> level) + 1 > kTopBlocks) ++level;
  return level;
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
  std::size_t kept = 0;
  for (std::size_t i = 0; i < x_cells.size(); ++i) {
    const std::int32_t x = x_cells[i], y = y_cells[i];
    if (x < 0 || y < 0 || x + border >= field.width() || y + border >= field.height()) continue;
    x_cells[kept] = x;
    y_cells[kept] = y;
    ++kept;
  }
  x_cells.resize(kept);
  y_cells.resize(kept);
}

int BranchAndBound::leastPenalty(const GuessPenalty& penalty, const PoseGrid& grid, int x, int y, int rotation,
                                 int level) {
  if (penalty.greatest == 0) return 0;
  const double middle = 0.5 * (grid.translations - 1), size = (1 << level) - 1;
  const auto gap = [&](int first) { return std::max({0.0, first - middle, middle - first - size}); };
  const double dx = gap(x), dy = gap(y);
  return penalty.at(dx * dx + dy * dy, rotation - 0.5 * (grid.rotations - 1));
}

const std::vector<std::int32_t>& BranchAndBound::offsetsAt(const LikelihoodField& field, int rotation, int level) {
  Rotation& r = rotations_[static_cast<std::size_t>(rotation)];
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
  // A block of the top level may begin inside the window and end beyond it.
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

  // The columns of the top level, in strips as wide as sumWindows adds.
  const int blocks = ((grid.translations - 1) >> top) + 1;
  const LikelihoodField::Level level = field.level(top);
  std::vector<std::uint16_t> sums(static_cast<std::size_t>(blocks) * kWindowColumns);
  nodes_.clear();
  for (int k = 0; k < grid.rotations; ++k) {
    Rotation& r = rotations_[static_cast<std::size_t>(k)];
    r.has_offsets.fill(false);
    cellsAt(field, x_m_, y_m_, grid.first_yaw_rad + k * grid.step_yaw_rad, grid.first_x_m, grid.first_y_m, border,
            r.x_cells, r.y_cells);
    const std::vector<std::int32_t>& offsets = offsetsAt(field, k, top);
    for (int x0 = 0; x0 < blocks; x0 += kWindowColumns) {
      sumWindows(instructions_, level.cells + x0, level.stride, offsets, blocks, sums.data());
      for (int y = 0; y < blocks; ++y)
        for (int x = x0; x < std::min(blocks, x0 + kWindowColumns); ++x)
          nodes_.push_back({sums[static_cast<std::size_t>(y * kWindowColumns + x - x0)] -
                                leastPenalty(penalty_, grid, x << top, y << top, k, top),
                            static_cast<std::int32_t>(nodes_.size()), static_cast<std::int16_t>(k),
                            static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
    }
  }

  const auto better = [](const Node& a, const Node& b) {
    return a.bound != b.bound ? a.bound > b.bound : a.order < b.order;
  };
  descend(field, *std::min_element(nodes_.begin(), nodes_.end(), better), top, grid, best);
  std::erase_if(nodes_, [&](const Node& node) { return node.bound <= best.score; });
  std::sort(nodes_.begin(), nodes_.end(), better);
  for (const Node& node : nodes_) {
    if (node.bound <= best.score) break;
    descend(field, node, top, grid, best);
  }
  return best;
}

/// Whether all poses of the block are.
bool BranchAndBound::isExcluded(const Node& node, int level) const {
  const int half = excluded_->half_translation, last = (1 << level) - 1;
  const int x = node.x << level, y = node.y << level;
  return std::abs(node.rotation - excluded_->center.rotation) <= excluded_->half_rotation &&
         x >= excluded_->center.x - half && x + last <= excluded_->center.x + half && y >= excluded_->center.y - half &&
         y + last <= excluded_->center.y + half;
}

void BranchAndBound::descend(const LikelihoodField& field, const Node& node, int level, const PoseGrid& grid,
                             BestPose& best) {
  if (node.bound <= best.score || (excluded_ != nullptr && isExcluded(node, level))) return;
  if (level == 0) {
    best = {node.bound, node.x, node.y, node.rotation};
    return;
  }
  const LikelihoodField::Level finer = field.level(level - 1);
  const std::vector<std::int32_t>& offsets = offsetsAt(field, node.rotation, level - 1);
  std::array<std::uint16_t, 2 * kWindowColumns> sums;
  sumWindows(instructions_, finer.cells + static_cast<std::ptrdiff_t>(2 * node.y) * finer.stride + 2 * node.x,
             finer.stride, offsets, 2, sums.data());
  std::array<Node, 4> children;
  for (int i = 0; i < 4; ++i) {
    const int dx = i % 2, dy = i / 2;
    Node& child = children[static_cast<std::size_t>(i)];
    const int x = 2 * node.x + dx, y = 2 * node.y + dy;
    child = {sums[static_cast<std::size_t>(dy * kWindowColumns + dx)] -
                 leastPenalty(penalty_, grid, x << (level - 1), y << (level - 1), node.rotation, level - 1),
             i, node.rotation, static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
    // Blocks wholly outside the window.
    if (x << (level - 1) >= grid.translations || y << (level - 1) >= grid.translations) child.bound = -1;
  }
  std::sort(children.begin(), children.end(),
            [](const Node& a, const Node& b) { return a.bound != b.bound ? a.bound > b.bound : a.order < b.order; });
  for (const Node& child : children) descend(field, child, level - 1, grid, best);
}

}  // namespace swiftlet::perception
