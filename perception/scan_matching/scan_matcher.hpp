// What every scan matcher offers: the pose of a scan in a reference that was given before, with an honest covariance,
// a quality that tells a failed match, and the direction it cannot see.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// The poses to be searched: guess +- half, along the axes of the reference frame.
struct SearchWindow {
  double half_translation_m = 0.1;
  double half_rotation_rad = 0.05;
};

struct MatchResult {
  common::Pose2 T_reference_body;  ///< The level frame of the scan in the reference frame.
  /// Of the additive errors (x_m, y_m along the reference axes, yaw_rad) of T_reference_body. Large, but finite, along
  /// what cannot be seen.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double quality = 0.0;         ///< Mean score of the matched points, in [0, 1]; 1: each lies on the reference.
  double overlap = 0.0;         ///< Share of matched points with any support in the reference, in [0, 1].
  bool failed = true;           ///< Do not use the pose.
  bool at_window_edge = false;  ///< The best pose lies at the edge of the window; a wider one may find a better.
  /// Unit vector in the reference frame along which the position is not held by the scene (a corridor's axis).
  std::optional<Eigen::Vector2d> unobservable_direction;
  common::Pose2 finest_T_reference_body;  ///< The best pose of the finest grid, before any averaging.
  int finest_score = 0;                   ///< Its integer score.
  int points_used = 0;
};

/// How a matcher works; see the header of each.
enum class MatcherKind { kCorrelative, kGaussNewton, kPointToLine };

/// Not thread-safe: one object per thread.
class ScanMatcher {
 public:
  virtual ~ScanMatcher() = default;

  virtual MatcherKind kind() const = 0;

  /// Forgets the reference.
  virtual void clearReference() = 0;
  /// Adds a scan to the reference at a pose.
  virtual void addReference(const ProjectedScan& scan, const common::Pose2& T_reference_body) = 0;
  /// Never fails loudly: without a reference or without points the result says `failed`.
  [[nodiscard]] virtual MatchResult match(const ProjectedScan& scan, const common::Pose2& guess_T_reference_body,
                                          const SearchWindow& window) = 0;
};

}  // namespace swiftlet::perception
