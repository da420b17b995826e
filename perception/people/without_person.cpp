#include "perception/people/without_person.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include "common/dynamic_obstacle.hpp"
#include "common/segment.hpp"

namespace swiftlet::perception {
namespace {

using Point = Eigen::Vector2d;

/// A beam that ends this far behind a cell has passed it: three cells of the map, more than the noise of the laser and
/// the error of a place in the map.
constexpr double kPast_m = 0.15;
/// The discs of a person are at most this far ahead: DynamicObstacles::discs predicts as far as this.
constexpr double kPredicted_s = 1.5;
/// The middle of a person is known this well; the discs of other people this near are left out, too.
constexpr double kSame_m = 0.4;

/// Between places of the trail that are farther apart the person may have taken another path.
constexpr double kConnected_m = 0.6;
constexpr double kTrailStep_m = 0.1;

class Cleared {
 public:
  Cleared(const common::OccupancyGrid& grid, const SeenPoints* seen) : grid_(grid), sees_(seen != nullptr) {
    if (sees_) ranges_ = SeenRanges(*seen);
  }

  /// The person is there.
  void clearPerson(const Point& place_map_m) { clear(place_map_m, common::kPersonInMap_m); }
  /// The person was there.
  void clearPlace(const Point& place_map_m) { clear(place_map_m, common::kPersonHalfWidth_m + grid_.resolution_m()); }
  void clearTrail(const std::vector<Point>& trail_map_m) {
    clearPlace(trail_map_m.front());
    for (std::size_t i = 1; i < trail_map_m.size(); ++i) {
      const Point leg_m = trail_map_m[i] - trail_map_m[i - 1];
      const int steps = leg_m.norm() < kConnected_m ? static_cast<int>(std::ceil(leg_m.norm() / kTrailStep_m)) : 1;
      for (int step = 1; step <= steps; ++step) clearPlace(trail_map_m[i - 1] + leg_m * step / steps);
    }
  }
  common::OccupancyGrid take() && { return std::move(grid_); }

 private:
  static constexpr common::occupancy::Cell kFree = 0;

  void clear(const Point& place_map_m, double surely_m) {
    const Point reach = Point::Constant(common::kPersonInMap_m);
    const common::CellIndex low = grid_.cellAt(place_map_m - reach), high = grid_.cellAt(place_map_m + reach);
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        if (!common::occupancy::isOccupied(grid_.at({x, y}))) continue;
        const Point center = grid_.centerOf({x, y});
        const double off_m = (center - place_map_m).norm();
        if (off_m <= surely_m || (off_m <= common::kPersonInMap_m && seenPast(center))) grid_.set({x, y}, kFree);
      }
  }
  bool seenPast(const Point& center) const {
    if (!sees_) return false;
    const Point offset_m = center - ranges_.from_map_m();
    return ranges_.range_m(offset_m) > offset_m.norm() + kPast_m;
  }

  common::OccupancyGrid grid_;
  bool sees_;
  SeenRanges ranges_;
};

}  // namespace

common::OccupancyGrid mapWithout(const PersonWatch& person, common::Time now, const common::OccupancyGrid& grid,
                                 const SeenPoints* seen) {
  Cleared cleared(grid, seen);
  cleared.clearTrail(person.trail_map_m());
  if (!person.hidden()) cleared.clearPerson(person.place_map_m(now));
  return std::move(cleared).take().snapshot();
}

std::vector<common::Disc> discsWithout(const PersonWatch& person, common::Time now, std::vector<common::Disc> discs) {
  const Point from = person.trail_map_m().back();
  const Point to = person.place_map_m(now) + kPredicted_s * person.velocity_map_m_s();
  std::erase_if(discs, [&](const common::Disc& disc) {
    const Point nearest = from + common::shareNearest(disc.center_map_m, from, to) * (to - from);
    return (disc.center_map_m - nearest).norm() < kSame_m;
  });
  return discs;
}

}  // namespace swiftlet::perception
