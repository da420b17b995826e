// Remembers the cells that may be glass. Glass returns only beams near its normal and lets all others through (Foster,
// Sun, Park, Kuipers 2013), so that beams at other angles would clear a pane that was seen.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "common/tiled_grid.hpp"

namespace swiftlet::perception {

/// How a beam met the surface that it ended on, by the returns beside it.
enum class Incidence : std::uint8_t { kUnknown, kAlongNormal, kAslant };

/// One byte a cell. A cell that was hit several times along one normal, and never aslant, may be glass. A cell that was
/// hit aslant is no glass. Not thread-safe; a snapshot may go to another thread.
class GlassMemory {
 public:
  explicit GlassMemory(double resolution_m) : cells_(resolution_m, 0) {}

  /// A beam of that direction, of any length, ended in the cell.
  void hit(common::CellIndex cell, const Eigen::Vector2d& beam_map, Incidence incidence);
  /// Whether a beam of that direction says nothing of the cell that it crosses, because it would go through glass.
  bool passesThrough(common::CellIndex cell, const Eigen::Vector2d& beam_map) const;

  GlassMemory snapshot() {
    cells_ = cells_.snapshot();
    return *this;
  }

 private:
  common::TiledGrid<std::uint8_t> cells_;
};

}  // namespace swiftlet::perception
