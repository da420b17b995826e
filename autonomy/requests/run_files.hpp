// Files that a mission requests in the folder of its run.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/rgbd_frame.hpp"

namespace swiftlet::autonomy {

struct SavedMap {
  std::string name;
  std::shared_ptr<const common::OccupancyGrid> grid;  ///< Never null.
};

struct Photo {
  std::string name;
  std::shared_ptr<const common::RgbdFrame> frame;  ///< Never null.
  common::Pose3 T_map_camera;                      ///< When the frame arrived; the vehicle holds its place then.
};

using RunFile = std::variant<SavedMap, Photo>;

}  // namespace swiftlet::autonomy
