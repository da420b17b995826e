// The fusion filter's step from one IMU sample to the next. Private to fusion.
#pragma once

#include <span>

#include <Eigen/Core>

#include "perception/fusion/filter_state.hpp"
#include "perception/fusion/fusion_config.hpp"
#include "perception/fusion/fusion_types.hpp"
#include "perception/fusion/imu_model.hpp"
#include "perception/fusion/measurement_history.hpp"
#include "perception/fusion/measurement_models.hpp"

namespace swiftlet::perception::fusion {

/// One IMU sample and the state after all measurements up to it.
struct Slot {
  ImuValue imu;
  Eigen::Vector3d up_body = Eigen::Vector3d::UnitZ();  ///< From the AHRS.
  double ahrs_yaw_rad = 0.0;
  bool attitude_due = false;
  bool at_rest = false;
  bool predicted = false;  ///< From the commands, not measured.
  /// As measured from the samples before; propellers shake some vehicles far more than others.
  double accelerometer_noise_m_s2_rthz = 0.0;
  FilterState state;
};

/// A pure function of the previous state and the measurements since; it holds only its configuration.
class FilterStep {
 public:
  explicit FilterStep(const FusionConfig& config);

  /// Computes now.state: integrates the IMU from `before` to `now` and applies each of `measured` at its time; these
  /// lie after `before` and up to `now`, in order. The measurements of the sample itself are applied at the end.
  /// Outliers are gated; state.diverged says whether the filter has diverged.
  void advance(const Slot& before, std::span<const Measurement> measured, Slot& now) const;

  /// Noise density of the specific force of a sample.
  double accelerometerNoise_m_s2_rthz(const Slot& slot) const;
  double gravity_m_s2() const { return config_.gravity_m_s2; }

 private:
  void apply(FilterState& state, const Measurement& measurement) const;
  void doubtAccelerometer(FilterState& state, const Linearized<3>& pose) const;
  void applySlot(FilterState& state, const Slot& slot) const;
  void updateByAhrs(FilterState& state, const Eigen::Vector3d& up_body) const;
  void updateByAhrsYaw(FilterState& state, double yaw_rad) const;
  void accumulateDrag(FilterState& state, const Slot& before, const Slot& now) const;
  void updateByGravity(FilterState& state, const Slot& s) const;
  /// Whether the specific force is taken for drag: not where it is taken for gravity.
  bool usesDrag() const { return config_.use_drag && !config_.use_gravity; }
  void updateByDrag(FilterState& state, double accelerometer_noise_m_s2_rthz) const;
  void updateByRelativePose(FilterState& state, const Measurement& measurement) const;
  /// The update of measurements that may be outliers. If their gate has been closed for `recovery_s` and `may_force` is
  /// true, `widen(state, residual, recovery_s)` widens the covariance, and the measurement is accepted.
  template <int K, typename Widen>
  void gatedUpdate(FilterState& state, GateMemory& gate, const Linearized<K>& measurement, double recovery_s,
                   Widen widen, bool may_force = true) const;

  FusionConfig config_;
  ImuNoise noise_;
};

}  // namespace swiftlet::perception::fusion
