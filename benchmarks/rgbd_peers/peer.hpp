// What is compared: a method that is given one frame after the other.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "mapping3d/odometry/frame_pyramid.hpp"

namespace swiftlet::rgbd_peers {

struct RecordedFrame {
  const common::RgbdFrame& frame;
  common::Duration depth_later;  ///< From the colour image to the depth image.
};

class Peer {
 public:
  virtual ~Peer() = default;
  /// `small` is the frame at 320 pixels of width, for methods that do not halve their pictures themselves.
  virtual void add(const RecordedFrame& recorded, const mapping3d::PyramidLevel& small) = 0;
  /// Of all frames, in their order, with all corrections; axes of `camera`. nullopt of those that are lost.
  virtual std::vector<std::optional<common::Pose3>> finish() = 0;
};

struct Contender {
  std::string name;
  std::function<std::unique_ptr<Peer>()> make;
};

}  // namespace swiftlet::rgbd_peers
