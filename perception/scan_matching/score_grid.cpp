#include "perception/scan_matching/score_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace swiftlet::perception {
namespace {

/// Poses that are less likely than the best by a factor of e to this power are ignored.
constexpr double kNegligible_log = 20.0;

int inStrips(int columns) { return (columns + kWindowColumns - 1) / kWindowColumns * kWindowColumns; }

}  // namespace

double ScoreGrid::poses(const PoseGrid& window) {
  const double side = window.translations + 2.0 * kMargin;
  return side * side * (window.rotations + 2.0 * kMargin);
}

void ScoreGrid::score(LikelihoodField& field, std::span<const float> x_m, std::span<const float> y_m,
                      const PoseGrid& window) {
  window_ = window;
  side_ = window.translations + 2 * kMargin;
  stride_ = inStrips(side_);
  const int rotations = window.rotations + 2 * kMargin, border = stride_ + 1;
  const std::size_t size = static_cast<std::size_t>(side_) * static_cast<std::size_t>(stride_);
  scores_.assign(size * static_cast<std::size_t>(rotations), 0);
  field.prepare(0, border);
  const double margin_m = kMargin * field.resolution_m();
  for (int k = 0; k < rotations; ++k) {
    BranchAndBound::cellsAt(field, x_m, y_m, window.first_yaw_rad + (k - kMargin) * window.step_yaw_rad,
                            window.first_x_m - margin_m, window.first_y_m - margin_m, border, x_cells_, y_cells_);
    scoreRotation(field, &scores_[size * static_cast<std::size_t>(k)]);
  }
}

void ScoreGrid::scoreRotation(const LikelihoodField& field, std::uint32_t* out) {
  const LikelihoodField::Level level = field.level(0);
  offsets_.resize(x_cells_.size());
  for (std::size_t i = 0; i < offsets_.size(); ++i) offsets_[i] = y_cells_[i] * level.stride + x_cells_[i];
  part_.resize(static_cast<std::size_t>(side_) * kWindowColumns);
  for (int strip = 0; strip < stride_; strip += kWindowColumns) {
    for (std::size_t begin = 0; begin < offsets_.size(); begin += kMaxWindowPoints) {
      const std::size_t count = std::min<std::size_t>(kMaxWindowPoints, offsets_.size() - begin);
      sumWindows(instructions_, level.cells + strip, level.stride, std::span(offsets_).subspan(begin, count), side_,
                 part_.data());
      for (int y = 0; y < side_; ++y)
        for (int x = 0; x < kWindowColumns; ++x)
          out[y * stride_ + strip + x] +=
              part_[static_cast<std::size_t>(y) * kWindowColumns + static_cast<std::size_t>(x)];
    }
  }
}

template <typename Visit>
void ScoreGrid::forEachRow(const Visit& visit) const {
  for (int k = 0; k < window_.rotations; ++k)
    for (int y = 0; y < window_.translations; ++y) visit(&scores_[indexOf(0, y, k)], y, k);
}

BestPose ScoreGrid::best(const GuessPenalty& penalty) const {
  BestPose best;
  forEachRow([&](const std::uint32_t* row, int y, int k) {
    for (int x = 0; x < window_.translations; ++x) {
      const int score = static_cast<int>(row[x]);
      if (score <= best.score) continue;
      const int less_penalty = score - BranchAndBound::leastPenalty(penalty, window_, x, y, k, 0);
      if (less_penalty > best.score) best = {less_penalty, x, y, k};
    }
  });
  return best;
}

ScoreSurface ScoreGrid::surfaceAround(const BestPose& pose) const {
  constexpr int kHalf = ScoreSurface::kHalf;
  ScoreSurface surface;
  for (int k = -kHalf; k <= kHalf; ++k)
    for (int y = -kHalf; y <= kHalf; ++y)
      for (int x = -kHalf; x <= kHalf; ++x) surface.at(x, y, k) = at(pose.x + x, pose.y + y, pose.rotation + k);
  return surface;
}

Eigen::Matrix3d ScoreGrid::spreadElsewhere(const BestPose& pose, double log_per_score) const {
  std::uint32_t top = 0;
  forEachRow([&](const std::uint32_t* row, int, int) {
    for (int x = 0; x < window_.translations; ++x) top = std::max(top, row[x]);
  });
  const auto floor = static_cast<std::uint32_t>(std::max(0.0, top - kNegligible_log / log_per_score));
  double all = 0.0;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  forEachRow([&](const std::uint32_t* row, int y, int k) {
    for (int x = 0; x < window_.translations; ++x) {
      if (row[x] < floor) continue;
      const double likelihood = std::exp(-log_per_score * (top - row[x]));
      all += likelihood;
      const int dx = x - pose.x, dy = y - pose.y, dk = k - pose.rotation;
      if (std::max({std::abs(dx), std::abs(dy), std::abs(dk)}) <= ScoreSurface::kHalf) continue;
      const Eigen::Vector3d away(dx, dy, dk);
      moments += likelihood * away * away.transpose();
    }
  });
  return all > 0.0 ? Eigen::Matrix3d(moments / all) : moments;
}

}  // namespace swiftlet::perception
