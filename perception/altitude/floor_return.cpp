#include "perception/altitude/floor_return.hpp"

#include "perception/altitude/ground_limits.hpp"

namespace swiftlet::perception::altitude {
namespace {

/// Longer than a table. As many cells as lie along it: the paths did not just cross.
constexpr double kLength_m = 2.0;

}  // namespace

bool FloorReturn::sawLevelOverFloor(int level, const Eigen::Vector2d& cell_map_m) {
  if (level != level_ || cells_ == 0) {
    level_ = level;
    cells_ = 0;
    extent_map_m_.setEmpty();
  }
  ++cells_;
  extent_map_m_.extend(cell_map_m);
  return cells_ * kCell_m >= kLength_m && extent_map_m_.diagonal().norm() >= kLength_m;
}

}  // namespace swiftlet::perception::altitude
