// The height of the vehicle and of the surfaces below it, from the laser beams a mirror bends down (Grzonka 2012,
// section IV-C, Algorithm 1; Grzonka 2009, section V-E).
//
// Stage 1, a Kalman filter over (z, v_z): predicted by the vertical acceleration; the levels known in the neighbourhood
// that explain a beam give one virtual measurement of the height over the take-off floor, as if nothing were below.
// Stage 2, one Kalman filter a level: what no level explains becomes a new level; a level is re-estimated only when the
// vehicle enters or leaves it (else level and height would drag each other away); a level grows by the cells where it
// was measured; two levels that meet and agree are joined:
//   h = (s_j^2 h_i + s_i^2 h_j) / (s_i^2 + s_j^2),   s^2 = s_i^2 s_j^2 / (s_i^2 + s_j^2).
//
// Where the paper leaves a choice, this filter never uses the same information twice: a level that is entered and the
// height learn from one innovation, each by its prior; while it is over a level the height is never surer than the
// level.
//
// Not every surface is flat. Over a slope (the back of a sofa) each measurement lies within its gate and all lean to
// one side. So a surface is believed when it was at one height for a while, a level is left alone when its innovations
// add up, and a measurement is given out only when that did not happen soon after. What rises or falls evenly for
// longer is flat, and the vertical speed was wrong: that is measured, too. Where the height has become unsure, a known
// level is entered only if it is likelier than a surface not known yet (docs/decisions/008).
//
// Heights are of the body origin over the take-off floor, which is level 0 at height 0 without error. The filter lives
// at the time of the last scan; the vehicle's present height comes from the fusion filter, which takes the virtual
// measurement as one of its measurements, and may stand in for stage 1.
// One thread. Deterministic: the order of the points given is the only order there is. No heap use in the steady state.
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

/// What one scan did.
struct AltitudeUpdate {
  /// Of a scan `publish_delay_s` ago: by then it is known whether it met a level or the beginning of a slope. None: no
  /// beam was explained by a known level (line 10), or it was a slope.
  std::optional<VirtualHeight> measurement;
  std::optional<double> height_above_ground_m;  ///< Over the highest surface below that two beams agree on.
  int levels_added = 0;
  int levels_joined = 0;
};

class MultilevelFilter {
 public:
  using Config = MultilevelConfig;

  explicit MultilevelFilter(const Config& config);
  ~MultilevelFilter();
  MultilevelFilter(MultilevelFilter&&) noexcept;
  MultilevelFilter& operator=(MultilevelFilter&&) noexcept;

  /// Starts anew, standing on the take-off floor: level 0 at the cells about `position_map_m`.
  /// `height_m` is that of the body origin while standing (measured by the mirror, or known from the airframe).
  void initialize(common::Time time, const Eigen::Vector2d& position_map_m, double height_m);
  bool initialized() const;

  /// The vertical acceleration over ENU (gravity and bias removed), at the IMU's rate. Kept until the scan that needs
  /// it: scans come late. A non-finite or out-of-order one is left out.
  void addAcceleration(common::Time time, double acceleration_up_m_s2);

  /// Algorithm 1 for one scan at `time`, the vehicle over `position_map_m`. Scans must come in order of time; an
  /// earlier one is ignored. Without accelerations since the last scan the velocity is predicted constant.
  /// `prior`, where given, is the height and vertical speed at `time` by a filter that knows more, the fusion filter
  /// that is given the measurements: it takes the place of the prediction by accelerations.
  AltitudeUpdate update(common::Time time, const Eigen::Vector2d& position_map_m, std::span<const GroundPoint> points,
                        const std::optional<HeightState>& prior = std::nullopt);

  const HeightState& state() const;
  /// Copies of all levels with their cells.
  common::LevelMap levels() const;
  /// Counts every change of any level; levels() need not be asked while it stays.
  std::uint64_t levelsVersion() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
