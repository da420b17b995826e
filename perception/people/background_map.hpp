// The map as it was a while ago. A live map soon contains a person who walks through it. The map of some seconds ago
// does not, so the person differs from it (background subtraction, Grzonka 2012, section IV-E).
#pragma once

#include <deque>
#include <memory>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"

namespace swiftlet::perception {

/// A map that was made before the flight, as long as the vehicle knows its place in it: what is occupied there is no
/// person.
struct GivenBackground {
  std::shared_ptr<const common::OccupancyGrid> grid;
  common::Pose2 T_grid_map;
};

/// A history of maps. Not thread-safe.
class BackgroundMap {
 public:
  explicit BackgroundMap(common::Duration age) : age_(age) {}
  /// Adds a map. Call for each new map; cheap, because tiles are shared. Call restart() first if the whole map was
  /// corrected.
  void add(common::Time stamp, std::shared_ptr<const common::OccupancyGrid> grid);
  /// Forgets all maps.
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
