// Key scans of the 2D map, and poses relative to them.
//
// A correction such as a loop closure moves the key scans in `map`. A pose stored in `map` would then be wrong. A pose
// stored relative to a key scan moves with it and needs no new measurement.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

/// A pose of the body relative to a key scan. The frame of a key scan is level and its origin is on the take-off floor,
/// so z of T_key_body is the height over that floor, and its roll and pitch are those of the body.
struct KeyRelativePose {
  int key = 0;  ///< Index into KeyPoses::keys; a key scan keeps its index for the whole flight.
  Pose3 T_key_body;
};

struct KeyPose {
  Time stamp;  ///< Stamp of the scan.
  Pose2 T_map_key;
  /// Where there is no laser, key frames of a camera take the place of key scans. Their frame is that of the camera,
  /// whose pose has six degrees of freedom, and replaces the level frame of a scan.
  std::optional<Pose3> T_map_camera = std::nullopt;
};

/// The poses of all key scans, as estimated so far. Immutable once published; a newer version replaces it.
struct KeyPoses {
  std::uint64_t version = 0;  ///< Grows when a key scan is added or a correction moves key scans.
  std::vector<KeyPose> keys;

  /// The level frame of a key scan, or the frame of a camera's key frame. It must be in `keys`; see KeyRelativePose.
  Pose3 T_map_level(int key) const {
    const KeyPose& pose = keys[static_cast<std::size_t>(key)];
    return pose.T_map_camera ? *pose.T_map_camera : lifted(pose.T_map_key, 0.0);
  }
  /// T_map_body of `pose`, whose key scan must be in `keys`.
  Pose3 inMap(const KeyRelativePose& pose) const { return T_map_level(pose.key) * pose.T_key_body; }
};

}  // namespace swiftlet::common
