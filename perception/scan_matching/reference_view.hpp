// What the scans of a reference have looked at. A point that lies where none of them looked can be explained by no
// pose: left in a sum of scores it pulls the scan to where they did look, and a robot that drives backwards along a
// corridor, where the walls beside it are ever new, seems to stand.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// Not thread-safe.
class ReferenceView {
 public:
  void clear() { scans_.clear(); }
  /// End points of a scan, in the order of their angles, in the frame of the body; no point of the body itself.
  void add(const std::vector<Eigen::Vector2f>& points_body_m, const common::Pose2& T_reference_body);
  /// At which of the points, in the frame of a body at `T_reference_body`, one of the scans looked, and would still
  /// look if its view ended `margin_m` nearer.
  std::vector<bool> sees(std::span<const float> x_m, std::span<const float> y_m, const common::Pose2& T_reference_body,
                         double margin_m) const;

 private:
  static constexpr int kBins = 360;
  struct Scan {
    common::Pose2 T_body_reference;
    std::array<float, kBins> seen_to_m{};    ///< About how far the beams of each degree went.
    std::array<float, kBins> sine_to_end{};  ///< Of the angle from there to the end of the view; 1 beyond 90 degrees.
  };
  static int binOf(double angle_rad);
  static bool looksAt(const Scan& scan, const Eigen::Vector2d& point_m, double margin_m);

  std::vector<Scan> scans_;
};

}  // namespace swiftlet::perception
