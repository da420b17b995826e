// Notices inertial samples that contradict the attitude of the AHRS and the thrust that was given, and replaces what
// contradicts by these, so that the filter continues with laser and height (Tomic 2012, "Action", requires a
// fall-back when the fusion diverges; here the fusion is kept from it).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

struct InertialCheckConfig {
  static constexpr double rate_deg_s = 25.0;    ///< Mean difference between the gyroscopes and the change of the AHRS'
                                                ///< attitude from which they are not used.
  static constexpr double rate_window_s = 0.1;  ///< Time over which rates are compared.
  static constexpr double vertical_m_s2 =
      3.5;  ///< Mean specific force along the rotors' axis beyond that of the given thrust from which the accelerometer
            ///< is not used; less force than that means that the vehicle sinks.
  static constexpr double vertical_window_s = 0.05;  ///< Time over which forces along the axis are compared.
  static constexpr double horizontal_m_s2 =
      2.5;  ///< Median specific force across the rotors' axis from which the accelerometer is not used.
  static constexpr double horizontal_window_s = 0.3;  ///< Time over which the median of forces across the axis is
                                                      ///< taken: more than twice that of a push of a hand.
  static constexpr double implied_spread_m_s2 = 4.0;  ///< A replaced specific force alternates by this much from sample
                                                      ///< to sample, so that the filter weights laser and height more.
  static constexpr double thrust_lag_s = 0.05;        ///< Lag of the thrust behind its command.
  static constexpr double trusted_again_s =
      1.0;  ///< Samples are used again once nothing has contradicted them for this long.
  static constexpr double land_after_s = 1.5;  ///< A contradiction that has lasted this long ends in a landing.
};

/// What the vehicle does, as far as it decides what a sample must be.
struct InertialContext {
  bool airborne = false;     ///< Flying, taking off or landing; on the ground nothing is compared.
  bool near_ground = false;  ///< The ground may carry a part of the weight: the thrust is no reference.
  bool thrust_applies = true;
  double thrust_over_hover = 1.0;  ///< Command given over the command that carries the weight.
};

/// A rotor pushes along the body's z axis and little else acts on a slow vehicle, so the specific force along it is
/// gravity times the share of the hover thrust, whatever the tilt, and that across it is small. The means over windows
/// are compared: vibration is ten times as large as the bias of a good sensor. One thread. Once the windows are full,
/// a sample allocates nothing.
class InertialCheck {
 public:
  explicit InertialCheck(const InertialCheckConfig& config);

  /// Call at each tick of the control.
  void vehicleIs(const InertialContext& context) { context_ = context; }
  /// The sample to be used: unchanged, or with the rates of the AHRS, or with the specific force of
  /// the thrust. A sample that is not finite is returned unchanged and left out.
  common::ImuSample checked(const common::ImuSample& sample);
  /// Samples are being replaced.
  bool contradicted() const { return rates_wrong_ || force_wrong_; }
  /// What contradicts what, with figures, for people; empty while all fits.
  std::string fault() const;
  /// The fault has lasted for land_after_s: the vehicle must come down while the other sensors hold it.
  bool mustLand(common::Time now) const;

 private:
  struct Compared {
    common::ImuSample sample;
    double expected_m_s2 = 0.0;  ///< Specific force along z.
    bool known = false;          ///< Whether the thrust determines it.
  };
  double expectedForce_m_s2(common::Time now);
  double impliedForce_m_s2(double expected_m_s2) const;
  Eigen::Vector3d ahrsRate_rad_s() const;
  std::optional<double> medianForce_m_s2(double span_s, int component);
  void compare(common::Time now);
  void compareRates(common::Time now);
  void compareForces(common::Time now);

  InertialCheckConfig config_;
  InertialContext context_;
  std::vector<Compared> window_;     ///< The last samples, oldest first, at most as long as the longest window.
  std::vector<double> sorted_m_s2_;  ///< Scratch of the median.
  double thrust_over_hover_ = 1.0;
  double spread_m_s2_ = 0.0;  ///< Of the last force that was replaced.
  std::optional<common::Time> last_, since_;
  std::optional<common::Time> rates_wrong_, force_wrong_;  ///< When they last were wrong.
  /// What the last sample contradicts; kNone if it is left out only because of earlier ones.
  enum class Fault { kNone, kRates, kAcross, kAlong };
  Fault fault_ = Fault::kNone;
  double fault_size_ = 0.0;  ///< In deg/s or m/s^2.
};

}  // namespace swiftlet::autonomy
