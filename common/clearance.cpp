#include "common/clearance.hpp"

#include <algorithm>
#include <vector>

namespace swiftlet::common {
namespace {

/// A part of a segment, by the shares of its ends, and the clearances there.
struct Stretch {
  double first, last;
  double at_first_m, at_last_m;

  /// Between its ends nothing can be nearer.
  double least_m(double length_m) const { return 0.5 * (at_first_m + at_last_m - (last - first) * length_m); }
};

}  // namespace

double ClearanceQuery::sweptClearance_m(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m,
                                        const UprightHull& hull, UnknownSpace unknown, double tolerance_m) {
  const Eigen::Vector3d displacement_map_m = to_map_m - from_map_m;
  const double length_m = displacement_map_m.norm();
  const double at_first_m = clearance_m(from_map_m, hull, unknown), at_last_m = clearance_m(to_map_m, hull, unknown);
  double least_asked_m = std::min(at_first_m, at_last_m);
  double least_m = least_asked_m;
  std::vector<Stretch> open{{0.0, 1.0, at_first_m, at_last_m}};
  while (!open.empty() && least_asked_m > 0.0) {
    const Stretch stretch = open.back();
    open.pop_back();
    if (const double bound_m = stretch.least_m(length_m); bound_m >= least_asked_m - tolerance_m) {
      least_m = std::min(least_m, bound_m);
      continue;
    }
    const double middle = 0.5 * (stretch.first + stretch.last);
    const double at_middle_m = clearance_m(from_map_m + middle * displacement_map_m, hull, unknown);
    least_asked_m = std::min(least_asked_m, at_middle_m);
    open.push_back({middle, stretch.last, at_middle_m, stretch.at_last_m});
    open.push_back({stretch.first, middle, stretch.at_first_m, at_middle_m});
  }
  return std::clamp(least_m, 0.0, least_asked_m);
}

}  // namespace swiftlet::common
