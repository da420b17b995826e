// Notices that the vehicle is over the floor again after its height went wrong: over a ramp that no camera saw, the
// height errs by what the ramp rises, and the floor behind it counts as a level of its own. Where that level covers
// place after place that was seen to be floor, it is the floor. No piece of furniture is put so exactly over what was
// flown over before, for metres and with no floor beside it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace swiftlet::perception::altitude {

/// One thread.
class FloorReturn {
 public:
  /// Resets: the floor itself is below, where it is expected, or nothing below says where it is.
  void reset() { cells_ = 0; }
  /// A level other than the floor was measured in a cell that was seen to be floor before; call it once for each cell
  /// and level. Returns true if the level is the floor.
  bool sawLevelOverFloor(int level, const Eigen::Vector2d& cell_map_m);

 private:
  int level_ = -1, cells_ = 0;
  Eigen::AlignedBox2d extent_map_m_;
};

}  // namespace swiftlet::perception::altitude
