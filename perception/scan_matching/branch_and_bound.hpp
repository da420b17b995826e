// The best of a grid of poses, found without looking at most of them: blocks of translations are bounded by the coarse
// levels of the likelihood field and split only while their bound beats the best pose known.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "perception/scan_matching/likelihood_field.hpp"
#include "perception/scan_matching/window_sums.hpp"

namespace swiftlet::perception {

/// The grid: rotation k in 0 .. rotations - 1 is first_yaw_rad + k * step_yaw_rad; translation (x, y), each in
/// 0 .. translations - 1, is (first_x_m + x * resolution, ...), in the reference frame.
struct PoseGrid {
  double first_x_m = 0.0;
  double first_y_m = 0.0;
  double first_yaw_rad = 0.0;
  double step_yaw_rad = 0.0;
  int rotations = 0;
  int translations = 0;
};

/// What a pose loses for its distance from the middle of the grid, the guess: the prior of the motion. It saturates, so
/// that a wrong guess does not outvote the scene.
struct GuessPenalty {
  int greatest = 0;                ///< In units of the score.
  double half_translations = 1.0;  ///< Half of it is lost at so many steps,
  double half_rotations = 1.0;     ///< or at so many of rotation.

  int at(double translations2, double rotations) const {
    return greatest == 0 ? 0 : ofShares(translationShare(translations2), rotationShare(rotations));
  }
  /// The same from its two parts, for who needs many.
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
  int score = -1;  ///< The sum less the penalty; -1: nothing was searched.
  int x = 0;
  int y = 0;
  int rotation = 0;
};

/// Poses within these distances of one pose, in steps of the grid; rotations that differ by a turn are the same.
struct ExcludedPoses {
  BestPose center;
  int half_translation = 0;
  int half_rotation = 0;
};

/// Keeps its buffers between searches. Not thread-safe.
class BranchAndBound {
 public:
  explicit BranchAndBound(Instructions instructions) : instructions_(instructions) {}

  /// The highest score of the grid, exactly; of equal ones any, but always the same. At most kMaxWindowPoints points,
  /// in the level frame of the scan.
  /// If none scores more than `floor`, the score is `floor` and found the sooner.
  BestPose search(LikelihoodField& field, const std::vector<Eigen::Vector2f>& points_m, const PoseGrid& grid,
                  const GuessPenalty& penalty = {}, int floor = -1);
  /// The same among the poses that are not excluded.
  BestPose searchElsewhere(LikelihoodField& field, const std::vector<Eigen::Vector2f>& points_m, const PoseGrid& grid,
                           const ExcludedPoses& excluded, int floor);

  /// The cells of all points at one rotation and translation; some may lie outside the field.
  static void allCellsAt(const LikelihoodField& field, std::span<const float> x_m, std::span<const float> y_m,
                         double yaw_rad, double shift_x_m, double shift_y_m, std::vector<std::int32_t>& x_cells,
                         std::vector<std::int32_t>& y_cells);
  /// The cells of the points at one rotation and the first translation, for scoring around the best. Points that can
  /// have no support anywhere in a window of `border` cells are left out.
  static void cellsAt(const LikelihoodField& field, std::span<const float> x_m, std::span<const float> y_m,
                      double yaw_rad, double shift_x_m, double shift_y_m, int border,
                      std::vector<std::int32_t>& x_cells, std::vector<std::int32_t>& y_cells);

  /// The least penalty in a block of 2^level translations a side.
  static int leastPenalty(const GuessPenalty& penalty, const PoseGrid& grid, int x, int y, int rotation, int level);

 private:
  struct Node {
    std::int32_t bound = 0;
    std::int32_t order = 0;  // Breaks ties.
    std::int16_t rotation = 0;
    std::int16_t x = 0;
    std::int16_t y = 0;

    bool isBetter(const Node& other) const { return bound != other.bound ? bound > other.bound : order < other.order; }
  };
  struct Rotation {
    std::vector<std::int32_t> x_cells;
    std::vector<std::int32_t> y_cells;
    std::array<std::vector<std::int32_t>, LikelihoodField::kLevels> offsets;
    std::array<bool, LikelihoodField::kLevels> has_offsets{};
  };

  void boundTopLevel(const LikelihoodField& field, const PoseGrid& grid, int top, int blocks, int border);
  const std::vector<std::int32_t>& offsetsAt(const LikelihoodField& field, int rotation, int level);
  BestPose searchFrom(LikelihoodField& field, const std::vector<Eigen::Vector2f>& points_m, const PoseGrid& grid,
                      BestPose best);
  bool isExcluded(const Node& node, int level) const;
  void descend(const LikelihoodField& field, const Node& node, int level, const PoseGrid& grid, BestPose& best);

  Instructions instructions_;
  const ExcludedPoses* excluded_ = nullptr;  // During a search only.
  int steps_per_turn_ = 0;                   // The same.
  GuessPenalty penalty_;
  std::vector<float> x_m_, y_m_;
  std::vector<Rotation> rotations_;
  std::vector<double> block_shares_;  // Of the penalty.
  std::vector<std::int32_t> bounds_;
  std::vector<Node> nodes_;
};

}  // namespace swiftlet::perception
