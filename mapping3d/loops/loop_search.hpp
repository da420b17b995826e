// Key frames of the same place as a new one, found by what they look like: similar binary words, then a pose that
// described points agree on, then the alignment of grey values and surfaces.
#pragma once

#include <vector>

#include "mapping3d/loops/key_frame_graph.hpp"
#include "mapping3d/odometry/rgbd_odometry.hpp"

namespace swiftlet::mapping3d {

/// The edges by which the track connects a new key frame, which gets this number: the frame aligned to each of the key
/// frames alone that it overlaps with, old ones only if there are no others; empty for the first. A pose that is
/// aligned to several key frames together contains no information on the drift between them.
std::vector<KeyFrameEdge> trackEdges(const FramePyramid& frame, const RgbdPose& pose, int number,
                                     const KeyFrameMap& keys, const RgbdOdometryConfig& odometry);

/// Alignments of the newest key frame to others that show the same place.
struct PlaceMatches {
  std::vector<KeyFrameEdge> loops;     ///< To old key frames of its own piece.
  std::vector<KeyFrameEdge> meetings;  ///< To those of other pieces. None if two of them contradict each other.
};

/// The newest of `keys` is `frame`; each key frame's scan is its number in the graph. Up to `candidates` key frames
/// that look most alike are tried; at 0 none. A pure function; it takes some milliseconds for each candidate.
PlaceMatches findPlace(const FramePyramid& frame, const RgbdPose& pose, const KeyFrameMap& keys,
                       const RgbdOdometryConfig& odometry, int candidates);

}  // namespace swiftlet::mapping3d
