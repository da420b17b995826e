// Branch and bound over a grid of poses: finds the best pose without scoring most of them. The coarse levels of the
// likelihood field bound the score of blocks of translations; a block is split only while its bound beats the best pose
// known.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "perception/scan_matching/likelihood_field.hpp"
#include "perception/scan_matching/window_sums.hpp"

namespace swiftlet::perception {

/// Rotation k (0 <= k < rotations) is first_yaw_rad + k * step_yaw_rad. Translation (x, y) (0 <= x, y < translations)
/// is (first_x_m + x * resolution, first_y_m + y * resolution) in the reference frame.
struct PoseGrid {
  double first_x_m = 0.0;
  double first_y_m = 0.0;
  double first_yaw_rad = 0.0;
  double step_yaw_rad = 0.0;
  int rotations = 0;
  int translations = 0;
};

/// The motion prior: the score that a pose loses for its distance from the guess, which is the middle of the grid. The
/// loss saturates, so that a wrong guess cannot outvote the scene.
struct GuessPenalty {
  int greatest = 0;                ///< Upper limit, in units of the score.
  double half_translations = 1.0;  ///< Distance, in grid steps, at which half of `greatest` is lost.
  double half_rotations = 1.0;     ///< Rotation, in grid steps, at which half of `greatest` is lost.

  int at(double translations2, double rotations) const {
    return greatest == 0 ? 0 : ofShares(translationShare(translations2), rotationShare(rotations));
  }
  /// Translation part of the penalty, for callers that combine many of them with ofShares().
  double translationShare(double translations2) const {
    return translations2 / (half_translations * half_translations);
  }
  double rotationShare(double rotations) const { return rotations * rotations / (half_rotations * half_rotations); }
  int ofShares(double translation, double rotation) const {
    const double r2 = translation + rotation;
    return static_cast<int>(greatest * (r2 / (1.0 + r2)));
  }
};

struct BestPose {
  int score = -1;  ///< The sum minus the penalty; -1: nothing was searched.
  int x = 0;
  int y = 0;
  int rotation = 0;
};

/// The poses within these distances of one pose, in grid steps. Rotations that differ by a full turn are the same.
struct ExcludedPoses {
  BestPose center;
  int half_translation = 0;
  int half_rotation = 0;
};

/// A block of poses in the search, with the bound of their scores.
struct SearchNode {
  std::int32_t bound = 0;
  std::int32_t order = 0;  // Breaks ties.
  std::int16_t rotation = 0;
  std::int16_t x = 0;
  std::int16_t y = 0;

  bool isBetter(const SearchNode& other) const {
    return bound != other.bound ? bound > other.bound : order < other.order;
  }
};

/// The cells of the points at one rotation, and their offsets at each level.
struct RotatedCells {
  std::vector<std::int32_t> x_cells;
  std::vector<std::int32_t> y_cells;
  std::array<std::vector<std::int32_t>, LikelihoodField::kLevels> offsets;
  std::array<bool, LikelihoodField::kLevels> has_offsets{};
};

/// Keeps its buffers between searches. Not thread-safe.
class BranchAndBound {
 public:
  explicit BranchAndBound(Instructions instructions) : instructions_(instructions) {}

  /// Finds exactly the highest score of the grid. If several poses have it, the choice is arbitrary but repeatable.
  /// Takes at most kMaxWindowPoints points, in the level frame of the scan. If no pose scores more than `floor`, the
  /// result has the score `floor`; a high floor makes the search faster.
  BestPose search(LikelihoodField& field, const std::vector<Eigen::Vector2f>& points_m, const PoseGrid& grid,
                  const GuessPenalty& penalty = {}, int floor = -1);
  /// As search(), without a penalty, among the poses that are not excluded.
  BestPose searchElsewhere(LikelihoodField& field, const std::vector<Eigen::Vector2f>& points_m, const PoseGrid& grid,
                           const ExcludedPoses& excluded, int floor);

  /// The field cells of all points at one rotation and translation. Some may lie outside the field.
  static void allCellsAt(const LikelihoodField& field, std::span<const float> x_m, std::span<const float> y_m,
                         double yaw_rad, double shift_x_m, double shift_y_m, std::vector<std::int32_t>& x_cells,
                         std::vector<std::int32_t>& y_cells);
  /// The field cells of the points at one rotation and the first translation of a window, for scoring the whole window.
  /// Points that have no support anywhere in a window of `border` cells are left out.
  static void cellsAt(const LikelihoodField& field, std::span<const float> x_m, std::span<const float> y_m,
                      double yaw_rad, double shift_x_m, double shift_y_m, int border,
                      std::vector<std::int32_t>& x_cells, std::vector<std::int32_t>& y_cells);

  /// The smallest penalty in a block of 2^level translations per side.
  static int leastPenalty(const GuessPenalty& penalty, const PoseGrid& grid, int x, int y, int rotation, int level);

 private:
  void boundTopLevel(const LikelihoodField& field, const PoseGrid& grid, int top, int blocks, int border);
  const std::vector<std::int32_t>& offsetsAt(const LikelihoodField& field, int rotation, int level);
  BestPose searchFrom(LikelihoodField& field, const std::vector<Eigen::Vector2f>& points_m, const PoseGrid& grid,
                      BestPose best);
  bool isExcluded(const SearchNode& node, int level) const;
  void descend(const LikelihoodField& field, const SearchNode& node, int level, const PoseGrid& grid, BestPose& best);

  Instructions instructions_;
  const ExcludedPoses* excluded_ = nullptr;  // Set only during searchElsewhere().
  int steps_per_turn_ = 0;                   // Rotation steps in a full turn; valid with excluded_.
  GuessPenalty penalty_;
  std::vector<float> x_m_, y_m_;
  std::vector<RotatedCells> rotations_;
  std::vector<double> block_shares_;  // Translation part of the penalty of each top-level block.
  std::vector<std::int32_t> bounds_;
  std::vector<SearchNode> nodes_;
};

}  // namespace swiftlet::perception
