// The beams of one scan that met the ground, or what stands on it, and the levels they end on. Private to altitude.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/tiled_grid.hpp"
#include "perception/altitude/height_measurement.hpp"
#include "perception/altitude/level_store.hpp"
#include "perception/altitude/multilevel_config.hpp"

namespace swiftlet::perception::altitude {

inline constexpr int kNoLevel = -1;

struct Beam {
  common::CellIndex cell;
  double distance_below_m = 0.0;
  int level = kNoLevel;
};

/// The beams of one scan that end on one level.
struct BeamGroup {
  int level = kNoLevel;
  int beams = 0;
  double distance_below_m = 0.0;  ///< Mean.
  double height_m = 0.0;          ///< Of the level, and its variance, as they were before this scan.
  double variance_m2 = 0.0;
};

/// Of the mean of so many distances to one surface.
double beamVariance_m2(const MultilevelConfig& config, int averaged);

/// No heap use in the steady state: it is read anew for each scan.
struct GroundScan {
  /// Without what has no return. All on no level.
  void read(const Eigen::Vector2d& position_map_m, std::span<const GroundPoint> points, const LevelStore& store);
  /// One past the last beam of the surface that begins with this one: beams in order, without a gap between them.
  std::size_t endOfSurface(std::size_t begin, double gap_m) const;
  /// Of the beams as they are on levels now.
  void group(const LevelStore& store);
  /// Down to the highest surface that so many beams agree on.
  std::optional<double> distanceToSurface_m(int needed_beams, double gap_m) const;

  std::vector<Beam> beams;        ///< The shortest first.
  std::vector<BeamGroup> groups;  ///< In order of their levels.
  common::CellIndex center;       ///< Of what is measured; tilted, that is not below the vehicle.
};

}  // namespace swiftlet::perception::altitude
