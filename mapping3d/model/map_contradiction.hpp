// Whether the parts of a 3D map agree where they overlap: a surface of one must not lie in what another has seen to be
// free.
#pragma once

#include <cstdint>
#include <span>

#include "common/key_pose.hpp"
#include "common/submap3d.hpp"

namespace swiftlet::mapping3d {

struct MapContradiction {
  std::uint64_t seen_twice = 0;     ///< Sampled surface points of a submap in the known space of another.
  std::uint64_t contradicting = 0;  ///< Of those, the ones in free space, with no surface near them.

  /// 0 if too little was seen twice.
  double share() const;
};

/// Submaps that grew from neighbouring frames count too, so a map without a loop closure is judged by what little its
/// submaps have in common. Things that moved contradict, as do wrong poses. A pure function.
MapContradiction contradictionOf(std::span<const common::Submap3d> submaps, const common::KeyPoses& keys);

}  // namespace swiftlet::mapping3d
