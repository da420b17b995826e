// The share of a scan that the map explains at a pose, and what it says about that pose.
#pragma once

#include <span>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/localization/map_field.hpp"

namespace swiftlet::perception {

/// A beam is explained when a wall is this near to its end; beams that meet the same piece of this size count once.
inline constexpr double kTolerance_m = 0.20;

/// How much of what a scan says the map explains. Beams that meet the same piece of wall, as long as the tolerance, are
/// one witness: a box beside the robot that is gone contradicts half of all beams, and yet only one thing has changed.
/// Beams that end on unknown cells carry no information and are left out.
struct ScanSupport {
  int beams = 0;           ///< Number of beams examined.
  int evidence = 0;        ///< Number of pieces of wall or of free space about which those beams say something.
  double explained = 0.0;  ///< Share of those pieces that are wall where beams end, with no wall before them.
};

ScanSupport supportOf(const MapField& map, std::span<const Eigen::Vector2f> points_body_m,
                      const common::Pose2& T_grid_body);

/// Page's cumulative sum test (1954): adds up the log-odds of the scans, never below zero. It detects a wrong pose
/// soon, however long the pose was right before. Not thread-safe.
class LostTest {
 public:
  void reset();
  void add(const ScanSupport& support, double elapsed_s);
  /// Log-odds that the pose is wrong, from this scan alone; 0 if it has too few informative beams.
  double logOdds(const ScanSupport& support) const;

  /// Whether the log-odds have reached those at which the pose counts as lost.
  bool lost() const;
  /// Whether there is any evidence against the pose: other poses are searched as well.
  bool doubtful() const;
  /// Moving average of the share explained.
  double explained() const { return explained_; }

 private:
  double sum_ = 0.0, explained_ = 1.0;
};

}  // namespace swiftlet::perception
