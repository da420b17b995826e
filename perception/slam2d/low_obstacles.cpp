#include "perception/slam2d/low_obstacles.hpp"

#include <algorithm>

namespace swiftlet::perception {
namespace {

/// Furniture is met, passed above, and met again; people are met at the height of the laser as well. With three
/// sightings a flight touched a table again (docs/decisions/cameras_and_lasers.md#084).
constexpr int kSightings = 2;
/// An obstacle stays certain for this time, times its sightings, while beams pass it and none meets it.
constexpr double kKept_s = 30.0;
/// A tilt lasts for some tenths of a second; a hit after this time is from another tilt.
constexpr double kApart_s = 0.5;
/// This many beams at the height of the laser in a row are no error of their heights.
constexpr int kLevel = 3;

}  // namespace

bool LowObstacles::isCertain(const Cell& cell) { return cell.sightings >= kSightings; }

bool LowObstacles::hit(common::CellIndex cell, int slice, common::Time now) {
  const Cell old = cells_.at(cell);
  Cell next = old;
  next.met = now;
  if (old.sightings == 0) {
    next.sightings = 1;
    next.top = static_cast<std::int16_t>(slice);
    next.passed = false;
  } else {
    // From another place or distance the same edge is drawn into the cell beside.
    int sightings = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell near = cells_.at({cell.x + dx, cell.y + dy});
        const bool again = near.passed && (now - near.met).seconds() >= kApart_s;
        sightings = std::max(sightings, again ? near.sightings + 1 : static_cast<int>(near.sightings));
      }
    next.sightings = static_cast<std::uint8_t>(std::min(sightings, 255));
    next.top = std::max<std::int16_t>(old.top, static_cast<std::int16_t>(slice));
    next.passed = false;
  }
  cells_.set(cell, next);
  return isCertain(old) != isCertain(next) || (isCertain(next) && old.top != next.top);
}

bool LowObstacles::passed(common::CellIndex cell, int slice, common::Time now) {
  const Cell old = cells_.at(cell);
  if (old.sightings == 0) return false;
  Cell next = old;
  if ((now - old.met).seconds() > kKept_s * old.sightings) {
    next = Cell{};
  } else if (slice > old.top) {
    next.passed = true;
    next.level = 0;
  } else {
    return false;
  }
  cells_.set(cell, next);
  return isCertain(old) != isCertain(next);
}

void LowObstacles::reachesUp(common::CellIndex cell) {
  const Cell old = cells_.at(cell);
  if (old.sightings == 0 || isCertain(old)) return;
  Cell next = old;
  if (++next.level >= kLevel) next = Cell{};
  cells_.set(cell, next);
}

void LowObstacles::forget(common::CellIndex cell) {
  if (cells_.at(cell).sightings > 0) cells_.set(cell, {});
}

std::optional<int> LowObstacles::top(common::CellIndex cell) const {
  const Cell known = cells_.at(cell);
  return isCertain(known) ? std::optional<int>(known.top) : std::nullopt;
}

}  // namespace swiftlet::perception
