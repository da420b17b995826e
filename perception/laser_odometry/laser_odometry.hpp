// Odometry from the laser alone: each scan is matched to a local map of the last key scans. A scan joins the local map
// only when it overlaps the map too little, fits it badly or is far from the reference, so that hovering does not drift
// (Bachrach 2009, section 5.1).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/time.hpp"
#include "perception/scan_matching/matcher_choice.hpp"
#include "perception/scan_matching/scan_matcher.hpp"

namespace swiftlet::perception {

class LeaningWalls;

/// The pose of the scan at `to` relative to the reference key scan at `from`.
///
/// The filter keeps a clone of its pose at `from`. When `reference_changed` is set, this measurement is still relative
/// to `from`, and the scan at `to` is the reference from the next measurement on: apply this one, then clone the pose
/// at `to`. The first scan, and the first one after the odometry was lost, have from == to: there is nothing to apply,
/// only a pose to clone.
struct RelativePose {
  common::Time from;
  common::Time to;
  common::Pose2 T_from_to;                               ///< Between the level frames of the two scans.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of (x_m, y_m, yaw_rad) in the frame at `from`.
  bool reference_changed = false;
  bool otherwise = false;  ///< The match was found from the other guess.
  /// The change of the pose at `to`, along the axes of that frame, that the scene does not show. Along it the pose is
  /// that of the guess.
  std::optional<common::UnobservableMotion> unobservable_motion;
};

/// Another pose at which a scan may have been taken, and how far around it to search.
struct OtherGuess {
  common::Pose2 T_odom_body;
  SearchWindow window;
};

struct LaserOdometryConfig {
  MatcherChoiceConfig matcher;
  double max_acceleration_m_s2 = 5.0;
  double guess_error_m =
      0.04;  ///< Half the least search window; at most max_window_m (docs/decisions/scan_matching.md#080).
  double max_window_m = 0.5;
  double max_window_deg = 15.0;
  double min_widened_quality = 0.35;
  bool widens = true;
  bool widened_must_hold = false;
  double min_fit = 0.35;
  int max_failures = 20;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

struct LaserOdometryCounts {
  std::uint64_t scans = 0;
  std::uint64_t failures = 0;  ///< Scans that did not match.
  /// Searches by each kind of matcher. A scan that is searched in wider windows takes several.
  std::uint64_t correlative_searches = 0;
  std::uint64_t gauss_newton_searches = 0;
  std::uint64_t point_to_line_searches = 0;
  std::uint64_t references = 0;    ///< Key scans that joined the local map.
  std::uint64_t restarts = 0;      ///< Times the odometry was lost and restarted.
  std::uint64_t out_of_order = 0;  ///< Scans not newer than the previous one; ignored.
};

/// Not thread-safe.
class LaserOdometry {
 public:
  /// `walls` says which walls do not stand upright, and must outlive the odometry; null: all of them do.
  explicit LaserOdometry(const LaserOdometryConfig& config, const LeaningWalls* walls = nullptr);
  ~LaserOdometry();
  LaserOdometry(LaserOdometry&&) noexcept;
  LaserOdometry& operator=(LaserOdometry&&) noexcept;

  /// Matches a scan to the local map. Returns nothing when it does not match. The guess is the pose of the last match,
  /// moved by the change of T_odom_body since then.
  ///
  /// `T_odom_last`: the pose that the predicting estimate now has for the body at `lastMatch()`. A filter that has
  /// taken in that match must give it, or its correction counts twice. The default is the prediction of that scan,
  /// which suits an odometry that is never corrected (wheels, a simulator).
  /// `first_window`: replaces the default window of the first search, for a caller that knows how good its prediction
  /// is. If that search fails, the window is widened anyway.
  /// `other`: tried when the first search fails. If it fits better, it replaces the prediction.
  [[nodiscard]] std::optional<RelativePose> add(const ProjectedScan& scan,
                                                const std::optional<common::Pose2>& T_odom_last = std::nullopt,
                                                const std::optional<SearchWindow>& first_window = std::nullopt,
                                                const std::optional<OtherGuess>& other = std::nullopt);

  /// Whether the estimate that predicts refused the last match. While it goes on refusing them, one of the two is
  /// wrong, and scans are also searched at the estimate's pose: the better fit is the match.
  void refused(bool by_estimate);

  /// The stamp of the last scan that matched.
  std::optional<common::Time> lastMatch() const;

  const LaserOdometryCounts& counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
