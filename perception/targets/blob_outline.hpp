// What is next to a blob in the picture: behind it, in front of it, or its own surface continued.
#pragma once

#include "common/rgbd_frame.hpp"
#include "perception/targets/colored_blobs.hpp"

namespace swiftlet::perception {

/// Counts of the pixels of a ring around a blob.
struct BlobOutline {
  int behind = 0;
  int in_front = 0;
  int level = 0;    ///< On the blob's surface continued.
  int unknown = 0;  ///< Without depth.

  int known() const { return behind + in_front + level; }
};

/// A plane has an inverse depth that is linear in the pixel. The blob's pixels fix one, and the depths of the ring are
/// compared with it; they differ if they are `relief_m` or three standard deviations of the camera's noise apart.
BlobOutline outlineOf(const ColoredBlob& blob, const common::RgbdFrame& frame, double relief_m);

}  // namespace swiftlet::perception
