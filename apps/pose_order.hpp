// Two trajectories to be compared, each with stamps, frame numbers or only an order.
#pragma once

#include <string>

#include "interfaces/files/pose_matrices.hpp"

namespace swiftlet::apps {

/// Gives both the same clock. Two with stamps, or two with frame numbers, have one. Stamps beside frame numbers must be
/// frame numbers themselves, or such at 30 frames a second, as `swiftlet map3d` writes them. Where one has nothing but
/// an order, both need as many poses, and the n-th of one belongs to the n-th of the other. Throws InputError
/// otherwise. Returns what tells the pairs.
interfaces::PoseOrder giveOneClock(const std::string& estimate_file, interfaces::RecordedPoses& estimate,
                                   const std::string& reference_file, interfaces::RecordedPoses& reference);

/// "stamps", "frame numbers", "order".
std::string toString(interfaces::PoseOrder order);

}  // namespace swiftlet::apps
