// Multi-resolution correlative scan matching: the best pose of a grid of poses by coarse-to-fine search with a bound,
// so that the answer is that of the exhaustive search at the finest resolution (Olson 2009, as used by Grzonka 2012,
// section IV-A, and Bachrach 2009, section 5.1). Scores are sums of bytes, the same on every machine.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/config.hpp"
#include "perception/scan_matching/scan_matcher.hpp"

namespace swiftlet::perception {

struct CorrelativeMatcherConfig {
  double resolution_m = 0.01;  ///< Of the finest level; each coarser one doubles it.
  double angular_resolution_deg = 0.1;
  int levels = 3;             ///< Resolutions that take part in the weighted mean (1, 2 and 4 cm; Grzonka 2012).
  double sigma_m = 0.02;      ///< Spread of the end points about the contour of the reference.
  int max_points = 256;       ///< Points of a scan that are matched, spread evenly along its contour.
  double max_range_m = 20.0;  ///< Points farther than this are not used; bounds the memory of the field.
  double max_gap_m = 0.3;     ///< Neighbouring end points of the reference nearer than this are joined to a contour.
  double min_quality = 0.35;  ///< Below this the match failed.
  int min_points = 30;        ///< With fewer points the match failed.
  double covariance_scale = 1.0;      ///< Factor on the covariance, calibrated so that the normalized error is honest.
  double unobservable_sigma_m = 0.5;  ///< A direction less certain than this is not seen.

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

/// Which instructions add up the scores. All give the same bits.
enum class Instructions { kScalar, kSse41, kAvx2 };
/// The best this machine has.
Instructions bestInstructions();
const char* toString(Instructions instructions);

class CorrelativeMatcher final : public ScanMatcher {
 public:
  explicit CorrelativeMatcher(const CorrelativeMatcherConfig& config, Instructions instructions = bestInstructions());
  ~CorrelativeMatcher() override;
  CorrelativeMatcher(CorrelativeMatcher&&) noexcept;
  CorrelativeMatcher& operator=(CorrelativeMatcher&&) noexcept;

  void clearReference() override;
  void addReference(const ProjectedScan& scan, const common::Pose2& T_reference_body) override;
  [[nodiscard]] MatchResult match(const ProjectedScan& scan, const common::Pose2& guess_T_reference_body,
                                  const SearchWindow& window) override;

  /// The oracle: every pose of the window at the finest resolution, one by one. Slow; `finest_*` are those of `match`.
  [[nodiscard]] MatchResult matchExhaustively(const ProjectedScan& scan, const common::Pose2& guess_T_reference_body,
                                              const SearchWindow& window);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
