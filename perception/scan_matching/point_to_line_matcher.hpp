// Iterative closest point with the point-to-line metric (Censi 2008, the laser odometry of Tomic 2012). Each iteration
// pairs every point of the scan with the contour line at the nearest point of the reference, leaves out the worst
// pairs, and takes one linear least-squares step; it ends when the pose no longer moves. It needs no map: a reference
// costs little, and the pose is not quantized by a grid.
#pragma once

#include <memory>

#include "perception/scan_matching/scan_matcher.hpp"

namespace swiftlet::perception {

/// The result is `failed` also if the steps did not become small, or led more than a centimetre or a tenth of a degree
/// out of the window.
class PointToLineMatcher final : public ScanMatcher {
 public:
  PointToLineMatcher();
  ~PointToLineMatcher() override;
  PointToLineMatcher(PointToLineMatcher&&) noexcept;
  PointToLineMatcher& operator=(PointToLineMatcher&&) noexcept;

  MatcherKind kind() const override { return MatcherKind::kPointToLine; }
  void clearReference() override;
  void addReference(const ProjectedScan& scan, const common::Pose2& T_reference_body) override;
  [[nodiscard]] MatchResult match(const ProjectedScan& scan, const common::Pose2& guess_T_reference_body,
                                  const SearchWindow& window) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
