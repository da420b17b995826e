// Scan to map by Gauss-Newton: the pose at which the sum of (1 - M)^2 over the end points is least, M being the map
// between its cells by bilinear interpolation (Saeedi, eq. 1). It goes down a pyramid of maps, coarse ones to come from
// afar and fine ones to be exact. It follows the slope, unlike the correlative matcher, which looks everywhere:
// cheaper, but a guess too far off ends in the wrong place, and says `failed`.
//
// M falls linearly with the distance to the nearest contour, so that (1 - M)^2 is what a LikelihoodField holds, 1 minus
// its value; the slope is that of the interpolated field, and the curvature follows from the normals of the scan's own
// contour, which a point exactly on the reference has too.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "perception/scan_matching/least_squares_match.hpp"
#include "perception/scan_matching/scan_contour.hpp"
#include "perception/scan_matching/scan_matcher.hpp"

namespace swiftlet::perception {

struct GaussNewtonMatcherConfig : LeastSquaresMatcherConfig {
  double resolution_m = 0.01;
  int levels = 3;
  int iterations = 4;
  int finest_iterations = 8;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

/// The result is `failed` also when the steps did not become small, or led more than a centimetre or a tenth of a
/// degree out of the window.
class GaussNewtonMatcher final : public ScanMatcher {
 public:
  explicit GaussNewtonMatcher(const GaussNewtonMatcherConfig& config);
  ~GaussNewtonMatcher() override;
  GaussNewtonMatcher(GaussNewtonMatcher&&) noexcept;
  GaussNewtonMatcher& operator=(GaussNewtonMatcher&&) noexcept;

  MatcherKind kind() const override { return MatcherKind::kGaussNewton; }
  void clearReference() override;
  void addReference(const ProjectedScan& scan, const common::Pose2& T_reference_body) override;
  /// Adds a shape that is no scan's, such as the surfaces of a map, in the reference frame.
  void addReference(std::span<const ContourSegment> contour_reference_m);
  [[nodiscard]] MatchResult match(const ProjectedScan& scan, const common::Pose2& guess_T_reference_body,
                                  const SearchWindow& window) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
