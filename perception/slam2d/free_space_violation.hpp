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

/// The free-space violation between two sets of scans, in [0, 1]. It is counted over the points of each set that the
/// other set has observed: the share that lies in free space of the other set.
/// A point is observed when beams of a scan of the other side end on both sides of its direction, and not all of them
/// in front of it. It lies in free space when all these beams of one scan end well behind it. Directions without return
/// are not evidence. The result is 0 when no point is observed.
/// Points beyond `max_range_m` from their own scan are left out. All poses are in one frame. Thread-safe.
double freeSpaceViolation(std::span<const PlacedScan> one, std::span<const PlacedScan> other, double max_range_m);

}  // namespace swiftlet::perception
