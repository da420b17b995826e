// Free-space violation: evidence against an alignment of scans whose walls fit. A corridor laid onto its own opposite
// wall, or a junction onto the next one, can fit well wherever both sides show walls. But walls of one side then lie in
// space that beams of the other side have crossed.
#pragma once

#include <span>

#include "common/geometry.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// A scan at an assumed pose. `scan` is neither owned nor null.
struct PlacedScan {
  const ProjectedScan* scan = nullptr;
  common::Pose2 T_map_body;
};

/// The points of two sets of scans that the other set has observed, and those among them that lie in its free space.
struct FreeSpaceEvidence {
  int points = 0;  ///< Of both sets.
  int observed = 0;
  int crossed = 0;

  /// In [0, 1]; 0 when no point is observed.
  double violation() const { return observed > 0 ? static_cast<double>(crossed) / observed : 0.0; }
};

/// A point is observed when beams of a scan of the other side end on both sides of its direction, and not all of them
/// in front of it. It lies in free space when all these beams of one scan end well behind it. Directions without return
/// are not evidence. Points beyond `max_range_m` from their own scan are left out. All poses are in one frame.
/// Thread-safe.
FreeSpaceEvidence freeSpaceEvidence(std::span<const PlacedScan> one, std::span<const PlacedScan> other,
                                    double max_range_m);

/// The free-space violation of that evidence.
double freeSpaceViolation(std::span<const PlacedScan> one, std::span<const PlacedScan> other, double max_range_m);

}  // namespace swiftlet::perception
