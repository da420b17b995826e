// Estimates the height of the vehicle and of the surfaces below it, from the laser beams that a mirror deflects down
// (Grzonka 2012, section IV-C, Algorithm 1; Grzonka 2009, section V-E).
//
// Stage 1 estimates height, vertical speed and accelerometer bias, and stage 2 the heights of the levels. The paper has
// a Kalman filter over (z, v_z) and one per level, and assigns a beam to a level if it is within its gate. A gate takes
// for certain what is not: over the back of a sofa each distance is within it, and with an accelerometer that is off by
// 2 % of gravity soon none is, and the height follows the accelerometer up to the ceiling. Therefore the assignment has
// several hypotheses (HypothesisBank), and the levels that are below are estimated together with the height. A surface
// of unknown height measures the vertical speed, where the paper predicts. A level is re-estimated when the vehicle
// leaves it. It grows by the cells where it was measured. Two levels that meet and agree are merged:
//   h = (s_j^2 h_i + s_i^2 h_j) / (s_i^2 + s_j^2),   s^2 = s_i^2 s_j^2 / (s_i^2 + s_j^2).
// What is gained by it stands in docs/decisions/altitude.md#112.
//
// Heights are those of the body origin above the take-off floor, which is level 0, at height 0 without error. The state
// is that of the time of the last scan. Single-threaded. Deterministic for a given order of the points.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/level_map.hpp"
#include "common/time.hpp"
#include "perception/altitude/height_measurement.hpp"
#include "perception/altitude/multilevel_config.hpp"

namespace swiftlet::perception {

/// The result of one scan.
struct AltitudeUpdate {
  /// What all scans so far say; nullopt if nothing was below in this one.
  std::optional<VerticalState> vertical;
  /// Above the highest surface below that several beams agree on.
  std::optional<double> height_above_ground_m;
  bool slopes = false;  ///< What is below slopes.
  int levels_added = 0;
  int levels_joined = 0;
  /// The correction of the height, where the assumed level turned out to be the floor.
  std::optional<double> floor_regained_m;
};

/// One scan.
struct GroundSight {
  common::Time stamp;
  Eigen::Vector2d position_map_m = Eigen::Vector2d::Zero();  ///< Of the vehicle.
  std::span<const GroundPoint> points;
  /// What is known of the vehicle without this filter. It is used where the filter knows no better: at first, and
  /// after a time without anything below.
  VerticalState known;
  /// Since the scan before; nullopt if that is not known.
  std::optional<InertialClimb> climb;
  bool at_rest = false;  ///< The vehicle stands.
  /// Of the ground below (rise over run, along x and y of the map): zero where it is level; nullopt if nobody saw it.
  std::optional<Eigen::Vector2d> gradient_map = {};
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

  /// Algorithm 1 for one scan. Scans must be in order of time; an earlier one is ignored.
  AltitudeUpdate update(const GroundSight& sight);

  VerticalState state() const;
  /// A copy of all levels with their cells.
  common::LevelMap levels() const;
  /// A counter that changes with every change of a level; levels() need not be called while it stays the same.
  std::uint64_t levelsVersion() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
