#include "perception/altitude/floor_return.hpp"

namespace swiftlet::perception::altitude {
namespace {

/// Longer than a table, and enough cells of 10 cm along that length that the paths did not just cross.
constexpr double kLength_m = 2.0;
constexpr int kCells = 15;

}  // namespace

bool FloorReturn::sawLevelOverFloor(int level, const Eigen::Vector2d& cell_map_m) {
  if (level != level_ || cells_ == 0) {
    level_ = level;
    cells_ = 0;
    extent_map_m_.setEmpty();
  }
  ++cells_;
  extent_map_m_.extend(cell_map_m);
  return cells_ >= kCells && extent_map_m_.diagonal().norm() >= kLength_m;
}

}  // namespace swiftlet::perception::altitude
