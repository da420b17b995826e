// The map as it was a while ago. A live map soon holds the person who walks through it; the map of some seconds ago
// does not, so that the person stands out against it (background subtraction, Grzonka 2012, section IV-E).
#pragma once

#include <deque>
#include <memory>

#include "common/occupancy_grid.hpp"
#include "common/time.hpp"

namespace swiftlet::perception {

/// One thread.
class BackgroundMap {
 public:
  explicit BackgroundMap(common::Duration age) : age_(age) {}
  /// Call at each new map; cheap, tiles are shared. Call restart() first when the map was corrected as a whole.
  void add(common::Time stamp, std::shared_ptr<const common::OccupancyGrid> grid);
  void restart() { history_.clear(); }
  /// The newest map that is at least `age` old, else the oldest; null when none was added.
  std::shared_ptr<const common::OccupancyGrid> at(common::Time now);

 private:
  struct Entry {
    common::Time stamp;
    std::shared_ptr<const common::OccupancyGrid> grid;
  };
  common::Duration age_;
  std::deque<Entry> history_;
};

}  // namespace swiftlet::perception
