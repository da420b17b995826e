// Ground that rises into the plane of the laser's fan. A fan at 1 m meets a ramp of 15 degrees 3.7 m ahead: in one scan
// it looks like a wall. Over several scans from different heights or attitudes it does not: the end points on a wall
// stay above each other, those on a ramp lie on a plane that slopes.
//
// Ground also goes on from the ground below the vehicle: its plane, extended to there, is no higher. A person who walks
// while the laser tilts leaves end points on a sloping plane as well, at the height of the chest.
//
//   end points, in odom --> a plane in each cell, of 3 s --> cells that slope --> beams that met ground
#pragma once

#include <map>

#include <Eigen/Core>

#include "common/tiled_grid.hpp"
#include "common/time.hpp"
#include "perception/altitude/ground_plane.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// One thread. In the frame `odom`, whose z is the height over the take-off floor.
class FanGround {
 public:
  /// Learns from a scan, taken from that pose and height; `surface_height_m` is the height of the ground below. Points
  /// that move are left out.
  void add(const ProjectedScan& scan, const common::Pose2& T_odom_body, double height_m, double surface_height_m);

  /// Makes floor hits of the end points that lie on ground that is known to slope.
  void remove(ProjectedScan& scan) const;

 private:
  /// The end points in a cell.
  struct Cell {
    common::Time since;
    GroundPlane plane;
  };
  struct Slope {
    GroundPlane plane;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Vector3d point_odom_m() const { return plane.mean_m(); }
    double height_m(const Eigen::Vector2d& place_odom_m) const {
      return point_odom_m().z() + gradient.dot(place_odom_m - point_odom_m().head<2>());
    }
  };
  bool isGround(const Eigen::Vector3d& point_odom_m) const;

  std::map<common::CellIndex, Cell> cells_;
  std::map<common::CellIndex, Slope> slopes_;
};

}  // namespace swiftlet::perception
