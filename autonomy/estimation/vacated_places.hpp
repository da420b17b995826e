// Places that a person has just left. A person who stands for a while is drawn into the slices of the map at every
// height that a tilting laser meets, and a hovering vehicle, whose beams stay in one slice, would clear these only in
// half a minute. Where level beams ended before and pass now, the place is free again, at every height of the hull
// (Grzonka 2012, V-E: the vehicle follows a detour once a person has moved out of its way).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::autonomy {

/// One thread. An obstacle that level beams never hit, such as a shelf, is not affected.
class VacatedPlaces {
 public:
  /// Takes in the beams of a scan. Passing beams count only while the vehicle hovers: in flight the slices are cleared
  /// by the changing tilt. Returns true if clear() now clears other cells than before.
  bool update(const perception::ProjectedScan& scan, const common::Pose2& T_map_body,
              const common::OccupancyGrid& grid);

  /// Makes the cells of vacated places free, but for those that are to be kept.
  void clear(common::OccupancyGrid& grid, const std::function<bool(common::CellIndex)>& is_kept) const;

 private:
  using Cell = std::pair<int, int>;
  /// A cell that level beams hit.
  struct Met {
    int hits = 0;
    common::Time seen;                         ///< When it was last hit or passed.
    std::optional<common::Time> passed_since;  ///< From when on beams have passed it and none has ended near it.
    common::Time passed_last;
    int passes = 0;  ///< Scans since then.
    bool vacated() const;
  };
  struct CellHash {
    std::size_t operator()(const Cell& cell) const {
      return std::hash<std::uint64_t>()(std::uint64_t{static_cast<std::uint32_t>(cell.first)} << 32U |
                                        static_cast<std::uint32_t>(cell.second));
    }
  };
  /// The cells of a scan, each once, in order.
  struct Beams {
    std::vector<Cell> ended, passed;
  };
  bool hovers(const perception::ProjectedScan& scan, const common::Pose2& T_map_body);
  Beams levelBeams(const perception::ProjectedScan& scan, const common::Pose2& T_map_body,
                   const common::OccupancyGrid& grid, bool hovers) const;
  bool pass(const Beams& beams, common::Time now);
  bool meet(const Beams& beams, common::Time now);

  void forget(common::Time now);

  std::unordered_map<Cell, Met, CellHash> met_;
  std::set<Cell> vacated_;  ///< Cells of `met_` that something has left.
  std::optional<common::Time> last_, forgot_;
  common::Pose2 last_pose_;
};

}  // namespace swiftlet::autonomy
