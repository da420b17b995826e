// The share of a scan that the map explains at a pose, and what it says about that pose.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "perception/localization/map_field.hpp"

namespace swiftlet::perception {

struct ScanSupportConfig {
  static constexpr int beams = 90;             ///< Beams of a scan, evenly spread, that are judged.
  static constexpr double tolerance_m = 0.20;  ///< A beam is explained when a wall is this near to its end; beams that
                                               ///< meet the same piece of this size count once.
  static constexpr double tolerance_rad =
      0.015;  ///< Growth of tolerance_m with the range, for the error of the heading.
};

/// How much of what a scan says the map explains. Beams that meet the same piece of wall, as long as the tolerance, are
/// one witness: a box beside the robot that is gone contradicts half of all beams, and yet only one thing has changed.
/// Beams that end on unknown cells carry no information and are left out.
struct ScanSupport {
  int beams = 0;           ///< Number of beams examined.
  int evidence = 0;        ///< Number of pieces of wall or of free space about which those beams say something.
  double explained = 0.0;  ///< Share of those pieces that are wall where beams end, with no wall before them.
};

ScanSupport supportOf(const MapField& map, std::span<const Eigen::Vector2f> points_body_m,
                      const common::Pose2& T_grid_body, const ScanSupportConfig& config);

struct LostTestConfig {
  static constexpr double at_none = 9.4;  ///< Log-odds of being lost when nothing of a scan is explained (logistic
                                          ///< regression on simulated walks, docs/localization.md).
  static constexpr double by_explained =
      -17.6;  ///< Change of the log-odds with the share explained (from the same regression as at_none).
  static constexpr double most = 3.0;  ///< Greatest log-odds that one scan adds, for or against.
  static constexpr double scans_per_s =
      2.0;  ///< Rate of scans that count as independent: scans closer in time see the same person in front.
  static constexpr double distrust_explained =
      0.75;  ///< While the map explains less than this share, other poses are searched as well.
  static constexpr double threshold = 5.0;   ///< Log-odds from which the pose counts as lost.
  static constexpr int least_evidence = 15;  ///< A scan that covers fewer pieces of wall or free space is left out.
};

/// Page's cumulative sum test (1954): adds up the log-odds of the scans, never below zero. It detects a wrong pose
/// soon, however long the pose was right before. Not thread-safe.
class LostTest {
 public:
  explicit LostTest(const LostTestConfig& config) : config_(config) {}

  void reset();
  void add(const ScanSupport& support, double elapsed_s);
  /// Log-odds that the pose is wrong, from this scan alone; 0 if it has too few informative beams.
  double logOdds(const ScanSupport& support) const;

  bool lost() const { return sum_ >= config_.threshold; }
  /// Whether there is any evidence against the pose.
  bool doubtful() const { return sum_ > 0.0 || explained_ < config_.distrust_explained; }
  /// Moving average of the share explained.
  double explained() const { return explained_; }

 private:
  LostTestConfig config_;
  double sum_ = 0.0, explained_ = 1.0;
};

}  // namespace swiftlet::perception
