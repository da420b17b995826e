// Whether an opening is a mirror. Depth behind a mirror is the space in front of it, seen by reflection: what is behind
// the plane, reflected in it, is where the laser sees something. Through a window it is not, except by chance.
//
// Source: the geometry of S.-W. Yang and C.-C. Wang, "Dealing with laser scanner failure: mirrors and windows", ICRA
// 2008, which compares the same two point sets.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "perception/recognition/wall_planes.hpp"

namespace swiftlet::perception {

/// A scan, in the coordinates of the level camera.
class LevelScan {
 public:
  /// `T_level_laser` takes coordinates of the laser to the level camera.
  LevelScan(const common::LaserScan& scan, const common::Pose3& T_level_laser);
  /// Points that were seen before are what is there where the scan says nothing.
  void addSeenBefore(const std::vector<Eigen::Vector3d>& points_m);

  /// Where the beams end, in their order: at what they return from, or at the laser's range. Without beams that are not
  /// valid.
  const std::vector<Eigen::Vector3d>& ends_m() const { return ends_m_; }
  const Eigen::Vector3d& origin_m() const { return origin_m_; }
  /// Horizontal length of the beam nearest in bearing to a point; not above 0 without a valid one near it.
  double rangeTowards_m(const Eigen::Vector3d& point_m) const;

 private:
  Eigen::Vector3d origin_m_;
  std::vector<Eigen::Vector3d> ends_m_;
  std::vector<double> ranges_m_;  ///< By steps of bearing; 0: nothing.
};

enum class Reflection {
  kNo,
  kYes,
  kMaybe,  ///< It would be of what the laser does not see: behind it.
};

/// Whether points behind the wall, as camera and laser see them in an opening, are a reflection of what the scan sees
/// before it.
Reflection reflectionOf(const std::vector<Eigen::Vector3d>& behind_m, const WallPlane& wall, const LevelScan& scan);

}  // namespace swiftlet::perception
