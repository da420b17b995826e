// Estimates the height of the vehicle and of the surfaces below it, from the laser beams that a mirror deflects down
// (Grzonka 2012, section IV-C, Algorithm 1; Grzonka 2009, section V-E).
//
// Stage 1 is a Kalman filter over (z, v_z). It starts each scan from the fusion filter's estimate, where the paper
// predicts with the vertical acceleration alone (docs/decisions/altitude.md#097). The known levels nearby that explain
// a beam give one virtual measurement of the height above the take-off floor, as if nothing else were below.
// Stage 2 is one Kalman filter per level. Surfaces that no level explains become new levels. A level is re-estimated
// only when the vehicle enters or leaves it; otherwise the errors of level and height would drift together. A level
// grows by the cells where it was measured. Two levels that meet and agree are merged:
//   h = (s_j^2 h_i + s_i^2 h_j) / (s_i^2 + s_j^2),   s^2 = s_i^2 s_j^2 / (s_i^2 + s_j^2).
//
// Where the paper leaves a choice, this filter never uses the same information twice. When a level is entered, the
// height and the level are corrected by one innovation, each according to its prior. While the vehicle is over a level,
// the height is never more certain than the level.
//
// Not every surface is flat. Over a slope (the back of a sofa) each measurement lies within its gate, but all have an
// error of the same sign. Therefore a new surface is accepted only after it stayed at one height for a while, a level
// is not used for a while after its innovations add up, and a measurement is published only if no slope was detected
// soon after it. A surface that rises or falls evenly for longer is flat, and the vertical speed was wrong; the speed
// is then corrected, too. If the height has become uncertain, a known level is entered only if it is likelier than an
// unknown surface (docs/decisions/altitude.md#008).
//
// Heights are those of the body origin above the take-off floor, which is level 0, at height 0 without error. The state
// is that of the time of the last scan. The vehicle's present height comes from the fusion filter, which uses the
// virtual measurements. Single-threaded. Deterministic for a given order of the points. No heap use in the steady
// state.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/level_map.hpp"
#include "common/time.hpp"
#include "common/vehicle_state.hpp"
#include "perception/altitude/height_measurement.hpp"
#include "perception/altitude/multilevel_config.hpp"

namespace swiftlet::perception {

/// The result of one scan.
struct AltitudeUpdate {
  /// The measurement of a scan `publish_delay_s` ago: by now it is known whether that scan was over a level or over the
  /// beginning of a slope. nullopt if no known level explained a beam (line 10), or if it was a slope.
  std::optional<VirtualHeight> measurement;
  /// Above the highest surface below that `min_cluster_beams` beams agree on.
  std::optional<double> height_above_ground_m;
  int levels_added = 0;
  int levels_joined = 0;
  /// The correction of the height, where the assumed level turned out to be the floor.
  std::optional<double> floor_regained_m;
};

class MultilevelFilter {
 public:
  using Config = MultilevelConfig;

  explicit MultilevelFilter(const Config& config);
  ~MultilevelFilter();
  MultilevelFilter(MultilevelFilter&&) noexcept;
  MultilevelFilter& operator=(MultilevelFilter&&) noexcept;

  /// Restarts, with the vehicle standing on the take-off floor: level 0 covers the cells around `position_map_m`.
  /// `height_m` is the height of the body origin while standing (measured by the mirror, or known from the airframe).
  void initialize(common::Time time, const Eigen::Vector2d& position_map_m, double height_m);
  bool initialized() const;

  /// Algorithm 1 for one scan at `prior.stamp`, with the vehicle at `position_map_m`. Scans must be in order of time;
  /// an earlier one is ignored. `prior` is the height and vertical speed from the fusion filter that receives the
  /// measurements. `over_slope`: the points are on a slope, lowered by its known rise to the level from which it began.
  AltitudeUpdate update(const HeightState& prior, const Eigen::Vector2d& position_map_m,
                        std::span<const GroundPoint> points, bool over_slope = false);

  const HeightState& state() const;
  /// A copy of all levels with their cells.
  common::LevelMap levels() const;
  /// A counter that changes with every change of a level; levels() need not be called while it stays the same.
  std::uint64_t levelsVersion() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
