#include "autonomy/planning_jobs/may_go.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "common/segment.hpp"

namespace swiftlet::autonomy {
namespace {

using common::CellIndex;
using common::CellRect;
using planning::CellState;

/// The outline of a person in the map: shoulders are 0.5 m at most (Pheasant 1996), with a cell of noise at each side;
/// of one who stands sideways a laser sees half of it.
constexpr double kLeastWidth_m = 0.25, kMostWidth_m = 0.65;
/// What is mapped this near to the middle of somebody is of the person, and not of a wall beside: half the shoulders
/// and two cells.
constexpr double kBody_m = common::kPersonHalfWidth_m + 0.10;
/// Behind somebody a laser sees nothing: without the person there is room for a hull, as far as is known.
constexpr double kBehind_m = 0.55;
/// Things nearer to each other than this are one.
constexpr double kSame_m = 0.3;
/// Beams that end partly on somebody draw specks this near to the middle of the body, beside it and behind it.
constexpr double kSpecks_m = 0.75;
/// Far more than the people of one flight.
constexpr std::size_t kMostPeople = 64;

/// The cells of the square around a disc.
template <typename Grid>
CellRect squareAround(const Grid& grid, const common::Disc& disc) {
  const Eigen::Vector2d corner = Eigen::Vector2d::Constant(disc.radius_m);
  const CellIndex last = grid.cellAt(disc.center_map_m + corner);
  return {grid.cellAt(disc.center_map_m - corner), {last.x + 1, last.y + 1}};
}

bool anythingIn(const planning::CostMap& map, const common::Disc& disc) {
  const CellRect cells = squareAround(map, disc);
  for (int y = cells.begin.y; y < cells.end.y; ++y)
    for (int x = cells.begin.x; x < cells.end.x; ++x)
      if (disc.covers(map.centerOf({x, y})) && map.states().at({x, y}) == CellState::kOccupied) return true;
  return false;
}

/// Occupied cells that touch each other, with their extent.
struct Thing {
  CellRect rect;
  bool too_large = false;
  std::vector<Eigen::Vector2d> cells_map_m;  ///< Their centres.
};

/// Of all that stands by itself, what is as wide as a person: free space was seen at both of its ends. A piece of a
/// wall that was seen in parts has free space before it only.
class StandingAlone {
 public:
  explicit StandingAlone(const planning::CostMap& map)
      : map_(map), thing_(map.costs().size(), 0), most_cells_(kMostWidth_m / map.resolution_m()) {}

  std::vector<common::Disc> find() {
    std::vector<common::Disc> discs;
    for (int i = 0; i < static_cast<int>(thing_.size()); ++i) {
      if (thing_[static_cast<std::size_t>(i)] != 0 || map_.states()[i] != CellState::kOccupied) continue;
      const Thing thing = spread(i);
      too_large_.push_back(thing.too_large);
      const double width_m = std::max(thing.rect.width(), thing.rect.height()) * map_.resolution_m();
      if (thing.too_large) continue;
      const Eigen::Vector2d low = map_.centerOf(thing.rect.begin);
      const Eigen::Vector2d high = map_.centerOf({thing.rect.end.x - 1, thing.rect.end.y - 1});
      const common::Disc around{0.5 * (low + high), 0.5 * (high - low).norm() + map_.resolution_m()};
      if (width_m < kLeastWidth_m)
        specks_.push_back(around);
      else if (hasFreeEnds(thing))  // Somebody who sways is drawn in pieces around what was seen first.
        discs.push_back({around.center_map_m, std::max(around.radius_m, kBody_m)});
    }
    return discs;
  }

  /// After find(): what is too small for a person.
  const std::vector<common::Disc>& specks() const { return specks_; }

  /// After find(): whether most of what is in the disc belongs to something larger, such as a wall that was seen on.
  bool isPartOfMore(const common::Disc& disc) const {
    int occupied = 0, of_more = 0;
    const CellRect cells = squareAround(map_, disc);
    for (int y = cells.begin.y; y < cells.end.y; ++y)
      for (int x = cells.begin.x; x < cells.end.x; ++x) {
        if (!map_.rect().contains({x, y}) || !disc.covers(map_.centerOf({x, y}))) continue;
        const int number = thing_[static_cast<std::size_t>(map_.indexOf({x, y}))];
        if (number == 0) continue;
        ++occupied;
        of_more += too_large_[static_cast<std::size_t>(number) - 1] ? 1 : 0;
      }
    return 2 * of_more > occupied;
  }

 private:
  Thing spread(int seed) {
    const CellIndex first = map_.cellOf(seed);
    Thing thing{{first, {first.x + 1, first.y + 1}}, false, {}};
    open_.assign(1, seed);
    const int number = static_cast<int>(too_large_.size()) + 1;
    thing_[static_cast<std::size_t>(seed)] = number;
    while (!open_.empty()) {
      const CellIndex at = map_.cellOf(open_.back());
      open_.pop_back();
      if (!thing.too_large) thing.cells_map_m.push_back(map_.centerOf(at));
      thing.rect.begin = {std::min(thing.rect.begin.x, at.x), std::min(thing.rect.begin.y, at.y)};
      thing.rect.end = {std::max(thing.rect.end.x, at.x + 1), std::max(thing.rect.end.y, at.y + 1)};
      thing.too_large = thing.rect.width() > most_cells_ || thing.rect.height() > most_cells_;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const CellIndex next{at.x + dx, at.y + dy};
          if (!map_.rect().contains(next) || map_.states().at(next) != CellState::kOccupied) continue;
          const int index = map_.indexOf(next);
          if (thing_[static_cast<std::size_t>(index)] != 0) continue;
          thing_[static_cast<std::size_t>(index)] = number;
          open_.push_back(index);
        }
    }
    return thing;
  }

  /// In some direction: the outline of somebody in a door may be as long and narrow as a piece of a wall.
  bool hasFreeEnds(const Thing& thing) const {
    constexpr int kDirections = 8;
    Eigen::Vector2d middle_map_m = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& cell_map_m : thing.cells_map_m) middle_map_m += cell_map_m;
    middle_map_m /= static_cast<double>(thing.cells_map_m.size());
    for (int i = 0; i < kDirections; ++i) {
      const double angle_rad = i * std::numbers::pi / kDirections;
      if (areEndsFree(thing, middle_map_m, {std::cos(angle_rad), std::sin(angle_rad)})) return true;
    }
    return false;
  }

  /// Of the nine cells beyond an end, a third lies before the line of a wall that goes on there unseen.
  bool areEndsFree(const Thing& thing, const Eigen::Vector2d& middle_map_m, const Eigen::Vector2d& axis) const {
    constexpr int kFreeBeyond = 4;
    double low_m = 0.0, high_m = 0.0;
    for (const Eigen::Vector2d& cell_map_m : thing.cells_map_m) {
      const double along_m = axis.dot(cell_map_m - middle_map_m);
      low_m = std::min(low_m, along_m);
      high_m = std::max(high_m, along_m);
    }
    const double beyond_m = 2.0 * map_.resolution_m();
    return freeAround(middle_map_m + (low_m - beyond_m) * axis) >= kFreeBeyond &&
           freeAround(middle_map_m + (high_m + beyond_m) * axis) >= kFreeBeyond;
  }

  /// Of nine cells.
  int freeAround(const Eigen::Vector2d& place_map_m) const {
    const CellIndex middle = map_.cellAt(place_map_m);
    int free = 0;
    for (int y = middle.y - 1; y <= middle.y + 1; ++y)
      for (int x = middle.x - 1; x <= middle.x + 1; ++x) free += map_.states().at({x, y}) == CellState::kFree ? 1 : 0;
    return free;
  }

  const planning::CostMap& map_;
  std::vector<int> thing_;       ///< Number of the thing that a cell belongs to, from 1; 0: none.
  std::vector<bool> too_large_;  ///< Of each thing.
  std::vector<int> open_;
  std::vector<common::Disc> specks_;
  double most_cells_;
};

}  // namespace

bool isLookPast(const planning::ExplorationAttempt& attempt, const Eigen::Vector2d& place_map_m) {
  // Past somebody in the middle of a door of 1.5 m; from 1 m away the shadow of a person is 1.5 m wide 2 m behind him.
  constexpr double kAside_m = 0.75, kBehind_m = 2.0;
  return (attempt.target_map_m - place_map_m).norm() < kBehind_m &&
         common::segmentDistance(place_map_m, attempt.place_map_m, attempt.target_map_m) < kAside_m;
}

void WhoMayGo::remember(std::span<const common::DynamicObstacle> people, const planning::CostMap& map) {
  for (const common::DynamicObstacle& person : people) {
    if (!person.moving) continue;
    std::erase_if(people_, [&](const Person& known) { return known.id == person.id; });
    if (people_.size() >= kMostPeople) people_.erase(people_.begin());
    people_.push_back({person.id, person.center_map_m});
  }
  const auto tracked = [&](const Person& known) {
    return std::any_of(people.begin(), people.end(), [&](const auto& person) { return person.id == known.id; });
  };
  std::erase_if(people_, [&](const Person& known) {
    return !tracked(known) && !anythingIn(map, {known.place_map_m, common::kPersonHalfWidth_m});
  });
}

std::vector<MayGo> WhoMayGo::in(const planning::CostMap& map, std::span<const Eigen::Vector2d> flown_map_m) {
  std::vector<MayGo> things;
  const auto known = [&](const Eigen::Vector2d& place_map_m) {
    return std::any_of(things.begin(), things.end(), [&](const MayGo& t) { return t.disc.covers(place_map_m); });
  };
  for (const Person& person : people_) things.push_back({{person.place_map_m, kBody_m}, "a person"});
  const int reach = static_cast<int>(map.footprint().hull_radius_m / map.resolution_m());
  for (const Eigen::Vector2d& place_map_m : flown_map_m) {
    const CellIndex middle = map.cellAt(place_map_m);
    for (int y = middle.y - reach; y <= middle.y + reach; ++y)
      for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
        const Eigen::Vector2d cell_map_m = map.centerOf({x, y});
        if (map.states().at({x, y}) != CellState::kOccupied || known(cell_map_m)) continue;
        if ((cell_map_m - place_map_m).norm() > map.footprint().hull_radius_m) continue;
        things.push_back({{cell_map_m, common::kPersonInMap_m}, "something that was not there before"});
      }
  }
  StandingAlone standing(map);
  for (const common::Disc& disc : standing.find()) {
    std::erase_if(stood_,
                  [&](const common::Disc& one) { return (one.center_map_m - disc.center_map_m).norm() < kSame_m; });
    if (stood_.size() < kMostPeople) stood_.push_back(disc);
  }
  std::erase_if(stood_, [&](const common::Disc& one) { return !anythingIn(map, one) || standing.isPartOfMore(one); });
  for (const common::Disc& disc : stood_)
    if (!known(disc.center_map_m)) things.push_back({disc, "something as wide as a person", false});
  const std::size_t whole = things.size();
  for (const common::Disc& speck : standing.specks())
    for (std::size_t i = 0; i < whole; ++i) {
      if ((things[i].disc.center_map_m - speck.center_map_m).norm() > kSpecks_m) continue;
      things.push_back({speck, things[i].who, things[i].came});
      break;
    }
  return things;
}

common::OccupancyGrid gridWithout(std::span<const MayGo> things, const common::OccupancyGrid& grid) {
  common::OccupancyGrid without = grid;
  without = without.snapshot();
  for (const MayGo& thing : things) {
    const common::Disc shadow{thing.disc.center_map_m, thing.disc.radius_m + kBehind_m};
    const CellRect cells = squareAround(grid, shadow);
    for (int y = cells.begin.y; y < cells.end.y; ++y)
      for (int x = cells.begin.x; x < cells.end.x; ++x) {
        const bool unknown = common::occupancy::isUnknown(grid.at({x, y}));
        const common::Disc& goes = unknown ? shadow : thing.disc;
        if (goes.covers(grid.centerOf({x, y})) && !common::occupancy::isFree(grid.at({x, y})))
          without.set({x, y}, -common::occupancy::kMaxSteps);
      }
  }
  return without;
}

}  // namespace swiftlet::autonomy
