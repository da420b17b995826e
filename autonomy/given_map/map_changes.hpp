// What has changed since the given map was made: things that stand where it has free space, and things of it that are
// gone. Each is reported once, with its place in the given map, so that the map can be corrected there.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/event_log.hpp"
#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// One thread. Both grids have the same cells.
class MapChanges {
 public:
  explicit MapChanges(common::EventLog& log) : log_(log) {}

  /// Compares the two grids, at most every few seconds. `laid` is the given map in the cells of the flight's map.
  void update(common::Time now, const common::OccupancyGrid& flown, const common::OccupancyGrid& laid,
              const common::Pose2& T_map_given);
  /// The place is lost, or the given map was replaced: changes that have not been reported are forgotten.
  void forget() { checks_.clear(); }

 private:
  enum class Change { kNew, kGone };
  using Square = std::pair<int, int>;  ///< Of one metre, in the given map.
  void judge(common::Time now, Change change, const std::map<Square, int>& cells);
  void report(common::Time now, Change change, const std::vector<Square>& squares);

  std::optional<common::Time> checked_;
  std::map<std::pair<Change, Square>, int> checks_;  ///< In a row, that found the change; it is reported at the last.
  common::EventLog& log_;
};

}  // namespace swiftlet::autonomy
