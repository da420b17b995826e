// Key frames of the same place as a new one, found by what they look like: similar binary words, then a pose that
// described points agree on, then the alignment of grey values and surfaces.
#pragma once

#include <vector>

#include "mapping3d/loops/key_frame_graph.hpp"
#include "mapping3d/odometry/rgbd_odometry.hpp"

namespace swiftlet::mapping3d {

/// The edge by which the track connects a new key frame, which gets this number: from the one that it overlaps most of
/// those that it was aligned to, an old one only if there is no other; empty for the first. A frame is aligned to all
/// of its key frames together, so its pose contains no information on the drift between old and new ones; findLoops
/// measures that.
std::vector<KeyFrameEdge> trackEdges(const RgbdPose& pose, int number, const KeyFrameMap& keys);

/// Edges from old key frames of `keys` to its newest one, which `frame` became; each key frame's scan is its number in
/// the graph. Up to `candidates` key frames that look most alike are tried; at 0 no loops are closed. A pure function;
/// it takes some milliseconds for each candidate.
std::vector<KeyFrameEdge> findLoops(const common::RgbdFrame& frame, const RgbdPose& pose, const KeyFrameMap& keys,
                                    const RgbdOdometryConfig& odometry, int candidates);

}  // namespace swiftlet::mapping3d
