// Walls that do not stand upright: roofs, tents, hulls of ships. A scan is no horizontal section of them as soon as the
// vehicle tilts or climbs: a roof of 45 deg at 3 m seems to come 0.26 m nearer at 5 deg of tilt. In each cell of a grid
// a plane is fitted to the ends of beams (the normal distributions transform, Biber and Strasser 2003, in space:
// Magnusson 2009); where it leans, ends are moved along it to one height.
//
//   ends of beams, at the poses of the filter --> mean and covariance in each cell --> plane --> leans as those around
//                                                                                         |
//   next scan -----------------------------------------------------------------------> ends at one height
//
// Where nothing leans, a scan stays as it is (docs/decisions/scan_matching.md#134).
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/tiled_grid.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// Not thread-safe.
class LeaningWalls {
 public:
  LeaningWalls() : cells_(kCell_m) {}

  /// Learns from the ends of the beams of a scan, with the pose of the body at its stamp.
  void add(const ProjectedScan& scan, const common::Pose3& T_odom_body);

  /// Whether anything that was seen leans.
  bool any() const { return leaning_cells_ > 0; }

  /// The scan with the ends on leaning walls moved along these to a height over the take-off floor. The scan is taken
  /// to be at its T_odom_body.
  ProjectedScan atHeight(const ProjectedScan& scan, double height_odom_m) const;

  struct Section {
    ProjectedScan scan;
    double moved_m = 0.0;  ///< Root mean square of how far the ends were moved.
  };
  /// The same for a match: without the ends of which it is not known where their surface is at that height.
  Section sectionAt(const ProjectedScan& scan, double height_odom_m) const;

 private:
  /// A plane must hold for the size of a cell, and a cell must be seen at several heights while it is crossed.
  static constexpr double kCell_m = 0.3;

  /// Sums over the ends in the cell, relative to its centre at the height of the take-off floor.
  struct Cell {
    float count = 0.0F;
    Eigen::Vector3f sum_m = Eigen::Vector3f::Zero();
    Eigen::Matrix3f squares_m2 = Eigen::Matrix3f::Zero();
    /// Horizontal, of length 1; zero while no plane is known.
    Eigen::Vector2f normal = Eigen::Vector2f::Zero();
    float lean = 0.0F;   ///< How far the wall moves along its normal for each metre of height; 0 if it stands upright.
    float added = 0.0F;  ///< Since the plane was fitted.
    bool wall = false;   ///< It leans, and so do others around, alike.
  };
  /// The sum of what was moved, squared, is added to `squares_m2`.
  ProjectedScan moved(const ProjectedScan& scan, double height_odom_m, bool only_known, double& squares_m2) const;
  void fit(Cell& cell);
  /// Decides anew whether the cell is part of a leaning wall.
  void judge(common::CellIndex index);
  /// How far the wall that the point lies on moves along x and y for each metre of height, by the nearest plane of its
  /// cell and those around; nullopt where none is known.
  std::optional<Eigen::Vector2d> leanAt(const Eigen::Vector3d& point_odom_m) const;

  common::TiledGrid<Cell> cells_;
  int leaning_cells_ = 0;  ///< That are part of a leaning wall.
};

}  // namespace swiftlet::perception
