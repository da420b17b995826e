// The score of every pose of a window. At a fixed rotation, the scores of all translations are the sum of one window of
// the likelihood field per point (Bachrach 2009, section 5.1.2). All scores together also tell how likely the pose is
// elsewhere in the window (section 5.1.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "perception/scan_matching/branch_and_bound.hpp"
#include "perception/scan_matching/likelihood_field.hpp"
#include "perception/scan_matching/score_surface.hpp"
#include "perception/scan_matching/window_sums.hpp"

namespace swiftlet::perception {

/// Keeps its buffers between calls. Not thread-safe.
class ScoreGrid {
 public:
  /// Poses scored beyond each side of the window, so that every pose in it has a full surface around it.
  static constexpr int kMargin = ScoreSurface::kHalf;

  explicit ScoreGrid(Instructions instructions) : instructions_(instructions) {}

  /// The number of poses of a window with its margin.
  static double poses(const PoseGrid& window);

  /// Scores all poses of the window and its margin. Takes any number of points, in the level frame of the scan.
  void score(LikelihoodField& field, std::span<const float> x_m, std::span<const float> y_m, const PoseGrid& window);

  /// The score of a pose. Each index is from -kMargin to the last of the window plus kMargin.
  std::uint32_t at(int x, int y, int rotation) const { return scores_[indexOf(x, y, rotation)]; }
  /// The highest score minus penalty. If several poses have it, the first by rotation, y and x.
  BestPose best(const GuessPenalty& penalty) const;
  ScoreSurface surfaceAround(const BestPose& pose) const;

  /// Second moments about a pose, in steps, of the likelihood of the poses of the window outside the surface around it.
  /// `log_per_score` is the derivative of the log-likelihood by the score.
  Eigen::Matrix3d spreadElsewhere(const BestPose& pose, double log_per_score) const;

 private:
  std::size_t indexOf(int x, int y, int rotation) const {
    const auto row = static_cast<std::size_t>(rotation + kMargin) * static_cast<std::size_t>(side_) +
                     static_cast<std::size_t>(y + kMargin);
    return row * static_cast<std::size_t>(stride_) + static_cast<std::size_t>(x + kMargin);
  }
  /// Calls visit(row, y, rotation) for each row of the window, with the scores of x = 0 .. translations - 1.
  template <typename Visit>
  void forEachRow(const Visit& visit) const;
  void scoreRotation(const LikelihoodField& field, std::uint32_t* out);

  Instructions instructions_;
  PoseGrid window_;
  int side_ = 0;    ///< Translations per side, with the margin.
  int stride_ = 0;  ///< side_ rounded up to whole strips of kWindowColumns.
  std::vector<std::uint32_t> scores_;
  std::vector<std::int32_t> x_cells_, y_cells_, offsets_;
  std::vector<std::uint16_t> part_;
};

}  // namespace swiftlet::perception
