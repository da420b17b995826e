// The area that the scans of a reference have observed. No pose can explain a point outside of this area. Such points
// bias the sum of the scores towards the observed area: a robot that drives backwards along a corridor, where new wall
// appears beside it all the time, would seem to stand still.
//
// Nor has a scan observed the back of a surface that it saw: in a doorway, the outer face of a wall would be matched to
// the inner one, and the pose be wrong by the thickness of the wall.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// Not thread-safe.
class ReferenceView {
 public:
  /// End points beyond `max_range_m` are not in the reference: the scans have seen up to there, and nothing is drawn.
  explicit ReferenceView(double max_range_m = std::numeric_limits<double>::infinity())
      : max_range_m_(static_cast<float>(max_range_m)) {}
  void clear() { scans_.clear(); }
  /// Adds the end points of a scan, ordered by angle, in the frame of the body. They must not include points on the
  /// body itself.
  void add(const std::vector<Eigen::Vector2f>& points_body_m, const common::Pose2& T_reference_body);
  enum class Sight : std::uint8_t {
    kSeen,
    kUnseen,
    kBackOfSeen,  ///< On the back of a surface that was seen, and that no scan saw from its side.
  };
  /// Judges the points, given in beam order in the frame of a body at `T_reference_body`. A point is seen if at least
  /// one scan observed it, from the side that its surface faces, at least `margin_m` inside the angular limits of the
  /// scan's view.
  std::vector<Sight> look(std::span<const float> x_m, std::span<const float> y_m, const common::Pose2& T_reference_body,
                          double margin_m) const;

 private:
  static constexpr int kBins = 360;
  /// Where the beams of a degree ended farthest away, and the unit normal there, zero if unknown.
  struct Surface {
    Eigen::Vector2f point_m = Eigen::Vector2f::Zero(), normal = Eigen::Vector2f::Zero();
  };
  struct Scan {
    common::Pose2 T_body_reference;
    std::array<Surface, kBins> surfaces;
    std::array<float, kBins> seen_to_m{};  ///< Approximate range of the beams in each degree.
    /// Sine of the angle from this bin to the end of the view; 1 from 90 degrees on.
    std::array<float, kBins> sine_to_end{};
  };
  static int binOf(double angle_rad);
  static bool isBack(const Scan& scan, const Eigen::Vector2d& point_m, const Eigen::Vector2d& normal);
  static bool looksAt(const Scan& scan, const Eigen::Vector2d& point_m, double margin_m);

  float max_range_m_;
  std::vector<Scan> scans_;
};

}  // namespace swiftlet::perception
