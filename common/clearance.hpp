// How much room a hull has at a place: what planners in three dimensions ask a map.
#pragma once

#include <Eigen/Core>

namespace swiftlet::common {

/// An upright cylinder about the body's origin, half of its height above it.
struct UprightHull {
  double radius_m = 0.0;
  double height_m = 0.0;
};

/// What space counts as of which nothing is known.
enum class UnknownSpace { kFree, kOccupied };

/// Answers for one map in its frame. One thread, as an implementation may keep what it has computed.
class ClearanceQuery {
 public:
  virtual ~ClearanceQuery() = default;

  /// Metres from the hull, centred at the point, to the nearest obstacle: 0 where they touch or overlap, and at most
  /// greatest_m(), which stands for all greater distances. 0 for a point that is not finite.
  virtual double clearance_m(const Eigen::Vector3d& center_map_m, const UprightHull& hull, UnknownSpace unknown) = 0;
  virtual double greatest_m() const = 0;

  /// The least clearance while the centre moves along the segment, at most `tolerance_m` (greater than 0) less than it
  /// truly is, and never more. Clearance changes by no more than the hull moves, so that few places have to be asked.
  double sweptClearance_m(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m, const UprightHull& hull,
                          UnknownSpace unknown, double tolerance_m);
};

}  // namespace swiftlet::common
