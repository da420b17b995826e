// Scan-to-map matching by Gauss-Newton: minimizes the sum of (1 - M)^2 over the end points, where M is the map
// interpolated bilinearly between its cells (Saeedi, eq. 1). It descends a pyramid of maps: coarse ones for a large
// basin of convergence, fine ones for accuracy. Unlike the correlative matcher, which searches the whole window, it
// follows the gradient. It is cheaper, but from a guess too far off it converges to a wrong pose and reports `failed`.
//
// M falls linearly with the distance to the nearest contour, so that (1 - M)^2 is 1 minus the value of a
// LikelihoodField. The gradient is that of the interpolated field. The curvature comes from the normals of the scan's
// own contour, which are known also for a point exactly on the reference.
#pragma once

#include <memory>
#include <span>

#include "perception/scan_matching/scan_contour.hpp"
#include "perception/scan_matching/scan_matcher.hpp"

namespace swiftlet::perception {

/// The result is `failed` also if the steps did not become small, or led more than a centimetre or a tenth of a degree
/// out of the window.
class GaussNewtonMatcher final : public ScanMatcher {
 public:
  GaussNewtonMatcher();
  ~GaussNewtonMatcher() override;
  GaussNewtonMatcher(GaussNewtonMatcher&&) noexcept;
  GaussNewtonMatcher& operator=(GaussNewtonMatcher&&) noexcept;

  MatcherKind kind() const override { return MatcherKind::kGaussNewton; }
  void clearReference() override;
  void addReference(const ProjectedScan& scan, const common::Pose2& T_reference_body) override;
  /// Adds a contour that does not come from a scan, such as the surfaces of a map, in the reference frame.
  void addReference(std::span<const ContourSegment> contour_reference_m);
  [[nodiscard]] MatchResult match(const ProjectedScan& scan, const common::Pose2& guess_T_reference_body,
                                  const SearchWindow& window) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
