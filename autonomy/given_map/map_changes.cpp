#include "autonomy/given_map/map_changes.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/occupied_near.hpp"

namespace swiftlet::autonomy {
namespace {

using common::CellIndex;
using common::OccupancyGrid;
namespace occupancy = common::occupancy;

constexpr double kInterval_s = 2.0;  ///< A difference is reported after 4 s: it is checked twice.
/// The same wall differs by as much in two maps: 1 deg at 10 m is 17 cm, and a cell on each side.
constexpr double kUnchangedWithin_m = 0.25;
/// Outline of the smallest change that is reported: a box of 15 cm shows one or two sides of it.
constexpr double kLeastOutline_m = 0.30;
/// A person who walks by is gone at the next check.
constexpr int kChecks = 3;

}  // namespace

void MapChanges::update(common::Time now, const OccupancyGrid& flown, const OccupancyGrid& laid,
                        const common::Pose2& T_map_given) {
  if (checked_ && (now - *checked_).seconds() < kInterval_s) return;
  checked_ = now;
  const int same_wall = static_cast<int>(std::lround(kUnchangedWithin_m / flown.resolution_m()));
  const common::Pose2 T_given_map = T_map_given.inverse();
  const auto squareOf = [&](CellIndex cell) {
    const Eigen::Vector2d at_m = T_given_map * flown.centerOf(cell);
    return Square(static_cast<int>(std::floor(at_m.x())), static_cast<int>(std::floor(at_m.y())));
  };
  std::map<Square, int> appeared, gone;
  flown.forEachCell([&](CellIndex cell, occupancy::Cell value) {
    if (occupancy::isOccupied(value) && occupancy::isFree(laid.at(cell)) &&
        !common::occupiedNear(laid, cell, same_wall))
      ++appeared[squareOf(cell)];
    if (occupancy::isFree(value) && occupancy::isOccupied(laid.at(cell)) &&
        !common::occupiedNear(flown, cell, same_wall))
      ++gone[squareOf(cell)];
  });
  const int least = static_cast<int>(std::lround(kLeastOutline_m / flown.resolution_m()));
  for (auto* cells : {&appeared, &gone})
    std::erase_if(*cells, [&](const auto& square) { return square.second < least; });
  judge(now, Change::kNew, appeared);
  judge(now, Change::kGone, gone);
}

void MapChanges::judge(common::Time now, Change change, const std::map<Square, int>& cells) {
  std::vector<Square> confirmed;
  std::erase_if(checks_, [&](const auto& entry) {
    return entry.first.first == change && entry.second < kChecks && !cells.contains(entry.first.second);
  });
  for (const auto& [square, count] : cells)
    if (++checks_[{change, square}] == kChecks) confirmed.push_back(square);
  if (!confirmed.empty()) report(now, change, confirmed);
}

void MapChanges::report(common::Time now, Change change, const std::vector<Square>& squares) {
  std::string places;
  for (const Square& square : squares)
    places += fmt::format("{}({:.1f}, {:.1f})", places.empty() ? "" : ", ", square.first + 0.5, square.second + 0.5);
  log_.info(now, "localization",
            change == Change::kNew ? "obstacle that is not in the given map"
                                   : "obstacle of the given map not seen at this height",
            "within half a metre of " + places + " in the given map");
}

}  // namespace swiftlet::autonomy
