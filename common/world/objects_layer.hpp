// The World's layer of recognized objects: windows, doors and known patterns that the camera has seen and placed in the
// map (Tomic 2012, section "Recognition"; the method is in perception/recognition).
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/passage.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

struct RecognizedObject {
  int id = 0;        ///< Unique in the flight; an object keeps it.
  std::string what;  ///< `window`, `door`, `opening` (its lower end was not seen), `mirror`, or the name of a pattern.
  /// Of an opening: origin in the middle of the hole, in the plane of the wall; x along the normal towards where it was
  /// seen from, horizontal; z up. Of a pattern its own axes: x right and y to its top on the paper, z out of it.
  Pose3 T_map_object;
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  ///< Of the place, along the axes of the map.
  double yaw_sigma_rad = 0.0;                               ///< Of the normal's or the pattern's heading.
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();         ///< Width and height, the greatest that was seen.
  Passage passage = Passage::kNone;  ///< kNone until it is confirmed, of mirrors and of patterns.
  int looks = 0;                     ///< Looks from places that differ.
  Time last_seen;
  bool confirmed = false;  ///< Seen from so many places that it is what `what` and `passage` say.

  /// Standard deviation of the place in its worst direction is at most this.
  double sigma_m() const { return std::sqrt(std::max(0.0, covariance_m2.trace())); }
};

inline bool operator==(const RecognizedObject& a, const RecognizedObject& b) {
  return a.id == b.id && a.what == b.what && a.T_map_object.position_m == b.T_map_object.position_m &&
         a.T_map_object.rotation.coeffs() == b.T_map_object.rotation.coeffs() && a.covariance_m2 == b.covariance_m2 &&
         a.yaw_sigma_rad == b.yaw_sigma_rad && a.size_m == b.size_m && a.passage == b.passage && a.looks == b.looks &&
         a.last_seen == b.last_seen && a.confirmed == b.confirmed;
}

/// "window 3".
inline std::string labelOf(const RecognizedObject& object) { return object.what + " " + std::to_string(object.id); }

struct ObjectsLayer {
  std::vector<RecognizedObject> objects;  ///< In the order of their ids.

  bool operator==(const ObjectsLayer&) const = default;
  /// Null without one of that id.
  const RecognizedObject* withId(int id) const {
    const auto found = std::find_if(objects.begin(), objects.end(), [id](const auto& one) { return one.id == id; });
    return found == objects.end() ? nullptr : &*found;
  }
};

}  // namespace swiftlet::common
