// What speaks against a pose though the walls agree: one side looked through what the other has seen. A corridor laid
// onto its own opposite wall, or a junction onto the next, fits well where both show something; but there are walls in
// what was seen to be free.
#pragma once

#include <span>

#include "common/geometry.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

struct PlacedScan {
  const ProjectedScan* scan = nullptr;
  common::Pose2 T_map_body;
};

/// Of the points of each side that a scan of the other side looked at, the share that one of them looked through: its
/// beams in that direction end well behind. Where a beam found nothing it says nothing. 0 where neither side looked at
/// what the other shows. Points beyond `max_range_m` are left out; all in one frame. Thread-safe.
double freeSpaceViolation(std::span<const PlacedScan> one, std::span<const PlacedScan> other, double max_range_m);

}  // namespace swiftlet::perception
