// The interface of all scan matchers: estimates the pose of a scan relative to a reference given before, with its
// covariance, a quality that identifies failed matches, and the unobservable motion.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/unobservable_motion.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// The poses to be searched: guess +- half along each axis of the reference frame.
struct SearchWindow {
  double half_translation_m = 0.1;
  double half_rotation_rad = 0.05;
};

struct MatchResult {
  common::Pose2 T_reference_body;  ///< Pose of the scan's level frame in the reference frame.
  /// Covariance of the additive errors of T_reference_body: (x_m, y_m, yaw_rad), along the axes of the reference.
  /// Large, but finite, along unobservable directions.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double quality = 0.0;  ///< Mean score of the matched points, in [0, 1]; 1: all lie on the reference.
  double overlap = 0.0;  ///< Share of matched points with any support in the reference, in [0, 1].
  bool failed = true;    ///< Do not use the pose.
  /// The best pose lies at the edge of the window; a wider window may contain a better one.
  bool at_window_edge = false;
  /// The change of the pose, along the axes of the reference, that the scene does not show: along a corridor's axis,
  /// about the middle of a round room.
  std::optional<common::UnobservableMotion> unobservable_motion;
  /// The best pose of the finest grid, or the last step of a least-squares match, before any averaging.
  common::Pose2 finest_T_reference_body;
  int finest_score = 0;  ///< Integer score of that pose.
  int points_used = 0;   ///< Points of the scan that were matched; 0: no search was made.
};

/// How a matcher works; see the header of each. The order is that of the words in MatcherChoiceConfig::describe.
enum class MatcherKind { kCorrelative, kGaussNewton, kPointToLine };

/// Not thread-safe: one object per thread.
class ScanMatcher {
 public:
  /// Below this mean score a match failed.
  static constexpr double kMinQuality = 0.35;
  /// With fewer points a match failed.
  static constexpr int kMinPoints = 30;
  /// Points farther than this are not used, which bounds the memory of the fields.
  static constexpr double kMaxRange_m = 20.0;

  virtual ~ScanMatcher() = default;

  virtual MatcherKind kind() const = 0;

  /// Forgets the reference.
  virtual void clearReference() = 0;
  /// Adds a scan to the reference at a pose.
  virtual void addReference(const ProjectedScan& scan, const common::Pose2& T_reference_body) = 0;
  /// Matches a scan against the reference, near the guess. Does not throw: without a reference or without enough points
  /// the result is `failed`.
  [[nodiscard]] virtual MatchResult match(const ProjectedScan& scan, const common::Pose2& guess_T_reference_body,
                                          const SearchWindow& window) = 0;
};

}  // namespace swiftlet::perception
