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
  /// Unit vector in the frame at `to` along which the scene does not fix the position. The position along it is that of
  /// the guess.
  std::optional<Eigen::Vector2d> unobservable_direction;
};

/// Another pose at which a scan may have been taken, and how far around it to search.
struct OtherGuess {
  common::Pose2 T_odom_body;
  SearchWindow window;
};

struct LaserOdometryConfig {
  MatcherChoiceConfig matcher;
  double max_acceleration_m_s2 = 5.0;
  static constexpr double max_angular_acceleration_rad_s2 =
      20.0;  ///< Angular acceleration that widens the search with the time since the last match.
  static constexpr double unseen_drift_m_s =
      0.5;  ///< Speed that widens the search with the time since all directions were seen, as the guess drifts.
  double guess_error_m = 0.04;  ///< Half the least search window; at most max_window_m.
  static constexpr double guess_error_deg =
      1.5;  ///< Half the least search window of the rotation; at most max_window_deg.
  double max_window_m = 0.5;
  double max_window_deg = 15.0;
  double min_widened_quality = 0.35;
  bool widens = true;
  bool widened_must_hold = false;
  static constexpr double min_overlap = 0.75;  ///< A scan with a smaller share of supported points joins the local map.
  double min_fit = 0.35;
  static constexpr double min_weak_overlap =
      0.93;  ///< Value of min_overlap where the position is weakly fixed in one direction.
  static constexpr double weak_sigma_m = 0.05;  ///< A position less certain than this in one direction is weakly fixed.
  static constexpr double max_reference_distance_m = 2.0;  ///< A scan this far from the reference joins the local map.
  static constexpr double max_reference_rotation_deg =
      60.0;                                      ///< A scan turned this much against the reference joins the local map.
  static constexpr double level_tilt_deg = 2.0;  ///< A scan tilted more than this is drawn with the error of its
                                                 ///< attitude, so that it joins the local map only when it must.
  static constexpr double tilted_overlap_margin = 0.15;  ///< A tilted scan joins the local map when its overlap is this
                                                         ///< much smaller than a level one's would have to be.
  static constexpr int local_map_scans = 8;              ///< Key scans kept in the local map.
  int max_failures = 20;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
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
  explicit LaserOdometry(const LaserOdometryConfig& config);
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
