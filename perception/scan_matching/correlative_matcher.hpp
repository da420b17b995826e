// Multi-resolution correlative scan matching: finds the best pose of a grid by a coarse-to-fine search with bounds, so
// that the result is that of the exhaustive search at the finest resolution (Olson 2009, as used by Grzonka 2012,
// section IV-A, and Bachrach 2009, section 5.1). Scores are sums of bytes and are the same on every machine.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "perception/scan_matching/scan_matcher.hpp"
#include "perception/scan_matching/window_sums.hpp"

namespace swiftlet::perception {

/// How the pose is computed from the scores. With the best grid pose alone the estimate of a hovering vehicle
/// oscillates. Both averages smooth it without a phase shift.
enum class PoseEstimate {
  kFinest,  ///< The best pose of the finest grid.
  /// Mean of the best poses of all levels, weighted by a Gaussian about the finest (Grzonka 2012, IV-A).
  kWeightedMean,
  kSurface,  ///< The peak of a quadratic fitted to the scores around the best pose of the finest grid.
  /// As kSurface, with every pose of the window scored from all `surface_points`: likely poses elsewhere in the window
  /// add to the covariance (Bachrach 2009, 5.1.2 and 5.1.3). For narrow windows.
  kScoreGrid,
};

struct CorrelativeMatcherConfig {
  double resolution_m = 0.01;
  double angular_resolution_deg = 0.1;  ///< Step of the rotation at the finest level.
  int levels = 3;
  PoseEstimate estimate = PoseEstimate::kSurface;
  double sigma_m = 0.02;  ///< Spread of the end points about the contour of the reference, from half a resolution_m up
                          ///< to what the field's kernel holds.
  static constexpr int search_points =
      256;                   ///< Points of a scan that are searched with, spread evenly along its contour.
  int surface_points = 512;  ///< Points from which pose and covariance are taken around the best.
  bool only_seen = true;
  double guess_weight = 0.1;
  double profile_half_m = 0.0;
  double min_normal_spread = 0.01;  ///< A motion that a smaller share of the contour faces is not observed: along a
                                    ///< corridor's axis, or about the middle of a round room.

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

class CorrelativeMatcher final : public ScanMatcher {
 public:
  /// Neighbouring end points of the reference nearer than this are joined to a contour; more than 0.3 m apart only
  /// along a straight line (measured: docs/decisions/scan_matching.md#106).
  static constexpr double kMaxGap_m = 10.0;

  explicit CorrelativeMatcher(const CorrelativeMatcherConfig& config = {},
                              Instructions instructions = bestInstructions());
  ~CorrelativeMatcher() override;
  CorrelativeMatcher(CorrelativeMatcher&&) noexcept;
  CorrelativeMatcher& operator=(CorrelativeMatcher&&) noexcept;

  MatcherKind kind() const override { return MatcherKind::kCorrelative; }
  void clearReference() override;
  void addReference(const ProjectedScan& scan, const common::Pose2& T_reference_body) override;
  [[nodiscard]] MatchResult match(const ProjectedScan& scan, const common::Pose2& guess_T_reference_body,
                                  const SearchWindow& window) override;

  /// The test oracle: scores every pose of the window at the finest resolution, one by one. Slow. `finest_score` equals
  /// that of `match`, and so does `finest_T_reference_body` unless several poses share the best score.
  [[nodiscard]] MatchResult matchExhaustively(const ProjectedScan& scan, const common::Pose2& guess_T_reference_body,
                                              const SearchWindow& window);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
