#include "perception/slam2d/columns.hpp"

#include <algorithm>

namespace swiftlet::perception {
namespace {

/// Longer than a beam misses the edge of something while the vehicle sways, shorter than two walkers follow each other
/// (docs/decisions/grid_map.md#059).
constexpr int kGone_ms = 2000;

}  // namespace

void Columns::ended(common::CellIndex cell, const Extent& met) {
  const Cell old = cells_.at(cell);
  Cell now = old;
  now.passed_ms = 0;
  const auto bottom = static_cast<std::int16_t>(met.bottom), top = static_cast<std::int16_t>(met.top),
             surely = static_cast<std::int16_t>(met.surely);
  now.lowest = std::min(old.lowest, bottom);
  now.highest = std::max(old.highest, top);
  now.surest = std::max(old.surest, surely);
  if (old.lowest <= old.highest) {
    const std::int16_t second_lowest = std::max(old.lowest, bottom), second_highest = std::min(old.highest, top);
    const bool empty = old.top < old.bottom;
    now.bottom = empty ? std::min(second_lowest, second_highest) : std::min(old.bottom, second_lowest);
    now.top = empty ? second_highest : std::max(old.top, second_highest);
    now.surely = std::max(old.surely, std::min(old.surest, surely));
  }
  // An unchanged cell is not written, so that its tile stays shared with the snapshots.
  if (now != old) cells_.set(cell, now);
}

int Columns::surelyAround(common::CellIndex cell) const {
  int surely = INT16_MIN;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) surely = std::max<int>(surely, cells_.at({cell.x + dx, cell.y + dy}).surely);
  return surely;
}

int Columns::topAround(common::CellIndex cell) const {
  int top = INT16_MIN;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const Cell& beside = cells_.at({cell.x + dx, cell.y + dy});
      if (beside.top >= beside.bottom) top = std::max<int>(top, beside.top);
    }
  return top;
}

std::optional<Columns::Extent> Columns::passed(common::CellIndex cell, const Pass& pass) {
  const Cell old = cells_.at(cell);
  if (pass.highest > old.top || pass.lowest < old.bottom || old.scan == pass.scan) return std::nullopt;
  Cell now = old;
  now.scan = pass.scan;
  now.passed_ms = static_cast<std::uint16_t>(
      std::min<std::int64_t>(kGone_ms, old.passed_ms + pass.lasts.nanoseconds() / 1'000'000));
  const bool gone = now.passed_ms >= kGone_ms;
  cells_.set(cell, gone ? Cell{} : now);
  return gone ? std::optional(Extent{old.bottom, old.top, old.surely}) : std::nullopt;
}

std::optional<Columns::Extent> Columns::takeBelow(common::CellIndex cell, int top) {
  const Cell old = cells_.at(cell);
  if (old.top < old.bottom || old.top >= top) return std::nullopt;
  cells_.set(cell, {});
  return Extent{old.bottom, old.top, old.surely};
}

}  // namespace swiftlet::perception
