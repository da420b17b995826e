// What later measurements hang on: a key scan of the 2D map, and a pose relative to it.
//
// T_map_odom jumps when the map is corrected, so a pose kept in `map` would stay behind. A pose kept relative to a key
// scan does not: a late correction (a loop closure) moves the key scans, and all that hangs on them moves along,
// without being measured again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

/// A pose of the body relative to a key scan. The frame of a key scan is its level frame, set down on the take-off
/// floor: z of T_key_body is the height over that floor, and roll and pitch are those of the body.
struct KeyRelativePose {
  int key = 0;  ///< Index into KeyPoses::keys; a key scan keeps its index for the whole flight.
  Pose3 T_key_body;
};

struct KeyPose {
  Time stamp;  ///< Of the scan.
  Pose2 T_map_key;
};

/// All key scans at their best poses so far. Immutable once published; a newer one replaces it.
struct KeyPoses {
  std::uint64_t version = 0;  ///< Grows when a key scan is added or a correction moves some.
  std::vector<KeyPose> keys;

  /// T_map_body by these key poses; the key scan must be among them.
  Pose3 inMap(const KeyRelativePose& pose) const {
    return lifted(keys[static_cast<std::size_t>(pose.key)].T_map_key, 0.0) * pose.T_key_body;
  }
};

}  // namespace swiftlet::common
