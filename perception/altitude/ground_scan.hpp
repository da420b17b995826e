// The beams of one scan that hit the ground or an object on it, and the levels they are assigned to. Private to
// altitude.
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

/// The beams of one scan that are assigned to one level.
struct BeamGroup {
  int level = kNoLevel;
  int beams = 0;
  double distance_below_m = 0.0;  ///< Mean.
  double height_m = 0.0;          ///< Height of the level before this scan.
  double variance_m2 = 0.0;       ///< Variance of that height before this scan.
};

/// Variance of the mean of `averaged` distances to one surface.
double beamVariance_m2(const MultilevelConfig& config, int averaged);

/// Reused for each scan, without heap use in the steady state.
struct GroundScan {
  /// Reads the beams of a scan. Leaves out beams without a return or longer than 60 m. No beam is assigned to a level
  /// yet.
  void read(const Eigen::Vector2d& position_map_m, std::span<const GroundPoint> points, const LevelStore& store);
  /// One past the last beam of the surface that starts with beam `begin`: successive beams without a gap wider than
  /// `gap_m`.
  std::size_t endOfSurface(std::size_t begin, double gap_m) const;
  /// Fills `groups` from the present assignment of the beams to levels.
  void group(const LevelStore& store);
  /// Distance down to the highest surface that `needed_beams` beams agree on, or all beams if there are fewer; nullopt
  /// if there is none.
  std::optional<double> distanceToSurface_m(int needed_beams, double gap_m) const;

  std::vector<Beam> beams;        ///< Shortest first.
  std::vector<BeamGroup> groups;  ///< Sorted by level.
  common::CellIndex center;  ///< Cell at the mean of the measured points; when tilted, this is not below the vehicle.
};

}  // namespace swiftlet::perception::altitude
