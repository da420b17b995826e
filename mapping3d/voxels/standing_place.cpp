#include "mapping3d/voxels/standing_place.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace swiftlet::mapping3d {
namespace {

struct Column {
  int x, y;
};

class StandingSearch {
 public:
  StandingSearch(const FreeSpace& space, const StandingRoom& room) : space_(space) {
    const auto up = [](double voxels) { return static_cast<int>(std::ceil(voxels - 1e-9)); };
    layers_ = std::max(1, up(room.height_m / space.voxel_m.z()));
    const int reach = up(room.radius_m / space.voxel_m.x());
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        // The parts of the two voxels that are nearest to each other: the vehicle may stand anywhere in its own.
        const double apart_m =
            std::hypot(std::max(0, std::abs(x) - 1), std::max(0, std::abs(y) - 1)) * space.voxel_m.x();
        if (apart_m <= room.radius_m) disc_.push_back({x, y});
        if (apart_m <= room.feet_radius_m) feet_.push_back({x, y});
      }
  }

  /// The lowest layer of the column's part.
  std::optional<int> floorOf(Column at, std::optional<double> height_m) const {
    const BitVolume& free = space_.free;
    const double wanted = height_m ? std::floor((*height_m - space_.corner_m.z()) / space_.voxel_m.z()) : 0.0;
    int begin = -1;
    for (int z = 0; z <= free.height(); ++z) {
      const bool open = free.at(at.x, at.y, z);
      if (open && begin < 0) begin = z;
      if (open || begin < 0) continue;
      const bool meant = height_m ? wanted >= begin && wanted < z : z - begin >= layers_;
      if (meant && (begin > 0 || !space_.open_below)) return begin;
      begin = -1;
    }
    return std::nullopt;
  }

  bool hasRoom(Column at, int floor) const {
    const BitVolume& free = space_.free;
    for (const Column& step : feet_)
      if (free.at(at.x + step.x, at.y + step.y, floor - 1)) return false;
    for (int z = floor; z < floor + layers_; ++z)
      for (const Column& step : disc_)
        if (!free.at(at.x + step.x, at.y + step.y, z)) return false;
    return true;
  }

  StandingPlace placeOf(const Eigen::Vector2d& at_m, Column at, int floor) const {
    int end = floor;
    while (space_.free.at(at.x, at.y, end)) ++end;
    return {{at_m.x(), at_m.y(), space_.cornerOf_m(0, 0, floor).z()},
            space_.cornerOf_m(0, 0, end).z(),
            space_.measured.at(at.x, at.y, floor - 1),
            space_.measured.at(at.x, at.y, end)};
  }

 private:
  const FreeSpace& space_;
  int layers_ = 1;
  std::vector<Column> disc_, feet_;
};

Column columnAt(const FreeSpace& space, const Eigen::Vector2d& at_m) {
  const Eigen::Vector2d voxels = (at_m - space.corner_m.head<2>()).cwiseQuotient(space.voxel_m.head<2>());
  constexpr double kFar = 1e9;
  return {static_cast<int>(std::floor(std::clamp(voxels.x(), -kFar, kFar))),
          static_cast<int>(std::floor(std::clamp(voxels.y(), -kFar, kFar)))};
}

Eigen::Vector2d centerOf(const FreeSpace& space, Column at) {
  return space.corner_m.head<2>() + Eigen::Vector2d(at.x + 0.5, at.y + 0.5) * space.voxel_m.x();
}

}  // namespace

std::optional<StandingPlace> floorAt(const FreeSpace& space, const Eigen::Vector2d& at_m, const StandingRoom& room,
                                     std::optional<double> height_m) {
  const StandingSearch search(space, room);
  const Column at = columnAt(space, at_m);
  const auto floor = search.floorOf(at, height_m);
  if (!floor) return std::nullopt;
  return search.placeOf(at_m, at, *floor);
}

std::optional<StandingPlace> measuredFloorNear(const FreeSpace& space, const Eigen::Vector2d& at_m,
                                               const StandingRoom& room, std::optional<double> height_m,
                                               double radius_m) {
  const StandingSearch search(space, room);
  const Column middle = columnAt(space, at_m);
  const int reach = static_cast<int>(radius_m / space.voxel_m.x());
  std::optional<StandingPlace> nearest;
  double nearest_m = radius_m;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const double distance_m = std::hypot(x, y) * space.voxel_m.x();
      if (distance_m > nearest_m || (nearest && distance_m == nearest_m)) continue;
      const Column at{middle.x + x, middle.y + y};
      const auto floor = search.floorOf(at, height_m);
      if (!floor || !space.measured.at(at.x, at.y, *floor - 1)) continue;
      nearest = search.placeOf(centerOf(space, at), at, *floor);
      nearest_m = distance_m;
    }
  }
  return nearest;
}

std::optional<StandingPlace> nearestStandingPlace(const FreeSpace& space, const Eigen::Vector2d& wanted_m,
                                                  const StandingRoom& room) {
  constexpr double kStep_m = 0.1;
  const StandingSearch search(space, room);
  const int step = std::max(1, static_cast<int>(kStep_m / space.voxel_m.x()));
  std::vector<std::pair<double, Column>> places;  // By their distance.
  for (int y = 0; y < space.free.depth(); y += step)
    for (int x = 0; x < space.free.width(); x += step) {
      places.emplace_back((centerOf(space, {x, y}) - wanted_m).squaredNorm(), Column{x, y});
    }
  std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [distance, at] : places) {
    const auto floor = search.floorOf(at, std::nullopt);
    if (!floor || !search.hasRoom(at, *floor)) continue;
    return search.placeOf(centerOf(space, at), at, *floor);
  }
  return std::nullopt;
}

}  // namespace swiftlet::mapping3d
