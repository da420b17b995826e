#include "perception/slam2d/glass_memory.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace swiftlet::perception {
namespace {

// A cell's byte: the direction of its normal in the low half, counted hits above it, and a bit for what is no glass.
// The two sides of a pane have the same direction.
constexpr int kSectors = 16;
constexpr std::uint8_t kSectorBits = 0x0F, kOneHit = 0x10, kHitBits = 0x70, kOpaque = 0x80;
/// It must have been hit this many times; a stray return is no pane.
constexpr std::uint8_t kEnoughHits = 4 * kOneHit;
/// Hits along one normal are up to 10 deg off it on either side, and so are the directions noted for them.
constexpr int kSameNormal = 3;
/// Panes return beams up to some 15 deg off their normal.
constexpr double kPasses_rad = 18.0 * std::numbers::pi / 180.0;

int sectorOf(const Eigen::Vector2d& direction) {
  const double turns = std::atan2(direction.y(), direction.x()) / std::numbers::pi;  // In half turns.
  return static_cast<int>(std::floor((turns + 1.0) * kSectors)) % kSectors;
}

int between(int sector, int other) {
  const int apart = std::abs(sector - other);
  return std::min(apart, kSectors - apart);
}

}  // namespace

void GlassMemory::hit(common::CellIndex cell, const Eigen::Vector2d& beam_map, Incidence incidence) {
  const std::uint8_t old = cells_.at(cell);
  if ((old & kOpaque) != 0 || incidence == Incidence::kUnknown) return;
  std::uint8_t now = old;
  const int sector = sectorOf(beam_map);
  if (incidence == Incidence::kAslant)
    now = kOpaque;
  else if ((old & kHitBits) == 0)
    now = static_cast<std::uint8_t>(kOneHit | sector);
  else if (between(sector, old & kSectorBits) > kSameNormal)
    now = kOpaque;
  else if ((old & kHitBits) != kHitBits)
    now = static_cast<std::uint8_t>(old + kOneHit);
  if (now != old) cells_.set(cell, now);
}

bool GlassMemory::passesThrough(common::CellIndex cell, const Eigen::Vector2d& beam_map) const {
  const std::uint8_t known = cells_.at(cell);
  if (known >= kOpaque || (known & kHitBits) < kEnoughHits) return false;
  const double normal_rad = ((known & kSectorBits) + 0.5) * std::numbers::pi / kSectors;
  const double off_rad = std::remainder(std::atan2(beam_map.y(), beam_map.x()) - normal_rad, std::numbers::pi);
  return std::abs(off_rad) > kPasses_rad;
}

}  // namespace swiftlet::perception
