// A map in the cells of another frame, without holes in its walls.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"

namespace swiftlet::autonomy {

/// A source map that is drawn into cells of `resolution_m`, in a frame that is turned and shifted against its own. Each
/// target cell takes the value that the source has at its centre. A wall that is thinner than the diagonal of a target
/// cell would get holes by that, because its cells lie between the centres; of such walls, the line through the centres
/// of their cells is drawn too. So cells that were neighbours (of eight) are still neighbours, or the same. One thread.
class ResampledMap {
 public:
  /// `source` is read only here and in `drawn`.
  ResampledMap(const common::OccupancyGrid& source, double resolution_m);

  double resolution_m() const { return resolution_m_; }
  /// The source in the frame of the result, placed by `T_target_source`.
  common::OccupancyGrid drawn(const common::OccupancyGrid& source, const common::Pose2& T_target_source) const;

 private:
  struct Point {
    Eigen::Vector2d at_source_m;
    common::occupancy::Cell value;
  };

  double resolution_m_;
  std::vector<Point> thin_walls_;
};

}  // namespace swiftlet::autonomy
