// Comes down without the fused estimate (Tomic 2012, "Action"): vertical speed from an alpha-beta filter on the raw
// height the mirror measures, and a level attitude once the last known velocity has been braked. Without raw heights
// the last height and speed are carried on, by the inertial samples or, without those, by the thrust model.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/time.hpp"
#include "common/vehicle.hpp"
#include "control/thrust_model.hpp"

namespace swiftlet::control {

/// One raw height over the surface below.
struct RawHeight {
  common::Time stamp;  ///< Time of the measurement.
  double height_m = 0.0;
};

/// Height and vertical speed from raw heights, by an alpha-beta filter. Its gains are those of the critically damped
/// filter, which forgets with one time constant at any rate of the heights:
///   alpha = 1 - theta^2,  beta = (1 - theta)^2,  theta = exp(-dt / tau).
/// A jump of the ground below (the edge of a table) moves the height but not the speed.
class AlphaBetaFilter {
 public:
  AlphaBetaFilter(double time_constant_s, double jump_m) : time_constant_s_(time_constant_s), jump_m_(jump_m) {}
  /// Ignores heights that are not finite and those older than the last one.
  void update(const RawHeight& raw);
  bool ready() const { return samples_ >= 2; }
  common::Time stamp() const { return stamp_; }
  double height_m() const { return height_m_; }
  double velocity_m_s() const { return velocity_m_s_; }

 private:
  double time_constant_s_, jump_m_;
  common::Time stamp_;
  double height_m_ = 0.0;
  double velocity_m_s_ = 0.0;
  int samples_ = 0;
};

/// Growth of the error of a vertical speed that inertial samples carry without a measured height: the bias of an
/// accelerometer after its calibration in flight. Measured: docs/decisions/fail_safes.md.
inline constexpr double kCarriedSpeed_m_s2 = 0.03;

/// Height over the surface below, and vertical speed.
struct VerticalMotion {
  double height_m = 0.0;
  double velocity_m_s = 0.0;
};

class EmergencyDescent {
 public:
  static constexpr double kDescent_m_s = 0.6;            ///< Speed of descent.
  static constexpr double kTouchdownDescent_m_s = 0.45;  ///< Speed of descent near the ground.
  /// Without a raw height for this long the last height and speed are carried on.
  static constexpr double kBlindAfter_s = 0.5;

  EmergencyDescent();

  /// Call it in every state, so that the filter is ready when it is needed.
  void observe(const RawHeight& raw) { filter_.update(raw); }
  /// `standing_height_m` is the height that the mirror measured on the ground. `velocity_level_m_s` is the last known
  /// horizontal velocity, in the body frame without roll and pitch; zero if none is known. `trim_level_m_s2`, in the
  /// same frame, balances wind, a wrong horizon and a wrong hover command: a horizon off by 1 deg would carry the
  /// vehicle 0.8 m in 3 s, and a command that lacks a tenth of the weight doubles the speed of the descent.
  void start(common::Time now, double standing_height_m, const Eigen::Vector2d& velocity_level_m_s,
             const Eigen::Vector3d& trim_level_m_s2 = Eigen::Vector3d::Zero());
  /// The yaw rate is zero. The tilt brakes the velocity given to start() without measuring it again.
  /// `carried` is the motion by the inertial samples, used while no raw height is fresh; nullopt if it is not known.
  common::Setpoint tick(common::Time now, double dt_s, const ThrustModel& thrust,
                        const std::optional<VerticalMotion>& carried = std::nullopt);
  bool touchedDown() const { return touched_down_; }
  /// The upward acceleration that the hover command lacks, by the trim and what the descent has found since.
  double lift_m_s2() const { return trim_level_m_s2_.z() + integral_m_s2_; }
  const AlphaBetaFilter& filter() const { return filter_; }

 private:
  /// `margin_m`: by how much the height may be wrong; `age_s`: the age of the motion.
  double wantedVelocity_m_s(double margin_m, double age_s) const;
  double accelerationFor(double wanted_m_s, double dt_s);
  double seenAcceleration_m_s2(common::Time now, double dt_s);
  double blindAcceleration_m_s2(common::Time now, double dt_s, const std::optional<VerticalMotion>& carried);

  AlphaBetaFilter filter_;
  Eigen::Vector2d velocity_left_m_s_ = Eigen::Vector2d::Zero();  ///< The velocity that is still to be braked.
  Eigen::Vector3d trim_level_m_s2_ = Eigen::Vector3d::Zero();
  common::Time last_seen_;  ///< When the ground was last measured; at first, when the descent started.
  common::Time last_moving_;
  common::Time last_fast_;  ///< When the measured height last changed.
  double standing_height_m_ = 0.0;
  double integral_m_s2_ = 0.0;
  VerticalMotion motion_;     ///< The last one that was seen, carried on by the thrust model.
  double given_m_s2_ = 0.0;   ///< The vertical acceleration of the last command, without the trim.
  double pushed_m_s2_ = 0.0;  ///< Downward acceleration added while the vehicle does not sink.
  bool touched_down_ = false;
};

}  // namespace swiftlet::control
