// What is compared: a method that is given one frame after the other.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/rgbd_frame.hpp"
#include "mapping3d/odometry/frame_pyramid.hpp"

namespace swiftlet::rgbd_peers {

class Peer {
 public:
  virtual ~Peer() = default;
  /// `small` is the frame at 320 pixels of width, for methods that do not halve their pictures themselves. False if it
  /// could not be placed.
  virtual bool add(const common::RgbdFrame& frame, const mapping3d::PyramidLevel& small) = 0;
  /// Of the frames that add() returned true for, in their order, with all corrections; axes of `camera`.
  virtual std::vector<common::Pose3> finish() = 0;
};

struct Contender {
  std::string name;
  std::function<std::unique_ptr<Peer>()> make;
};

}  // namespace swiftlet::rgbd_peers
