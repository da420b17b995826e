// Notices inertial samples that contradict the attitude of the AHRS and the thrust that was given, and replaces what
// contradicts by these, so that the filter continues with laser and height (Tomic 2012, "Action", requires a
// fall-back when the fusion diverges; here the fusion is kept from it).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/hysteresis.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// What the vehicle does, as far as it decides what a sample must be.
struct InertialContext {
  bool airborne = false;     ///< Flying, taking off or landing; on the ground nothing is compared.
  bool near_ground = false;  ///< The ground may carry a part of the weight.
  bool thrust_applies = true;
  double thrust_over_hover = 1.0;  ///< Command given over the command that carries the weight.
};

/// A rotor pushes along the body's z axis and little else acts on a slow vehicle, so the specific force along it is
/// gravity times the share of the hover thrust, whatever the tilt, and that across it is small. Means and medians over
/// windows are compared: vibration is ten times as large as the bias of a good sensor. What contradicts the thrust for
/// a moment was a push: the velocity of its samples, which were withheld, is in the sample that follows. One thread.
/// Once the windows are full, a sample allocates nothing.
class InertialCheck {
 public:
  InertialCheck();

  /// A replaced specific force alternates by this much from sample to sample, so that the filter, which measures the
  /// noise of its samples by their differences, weights laser and height more.
  static constexpr double kImpliedSpread_m_s2 = 4.0;

  /// Call at each tick of the control.
  void vehicleIs(const InertialContext& context) { context_ = context; }
  /// The sample to be used: unchanged, or with the rates of the AHRS, or with the specific force of
  /// the thrust. A sample that is not finite is returned unchanged and left out.
  common::ImuSample checked(const common::ImuSample& sample);
  /// Samples are being replaced, and not because of a push.
  bool contradicted() const;
  /// What contradicts what, with figures, for people; empty while all fits.
  std::string fault() const;

 private:
  /// Samples are used again once nothing has contradicted them for this long.
  static constexpr double kTrustedAgain_s = 1.0;
  struct Compared {
    common::ImuSample sample;
    double expected_m_s2 = 0.0;  ///< Specific force along z.
    bool known = false;          ///< Whether the thrust determines it.
  };
  double expectedForce_m_s2(common::Time now);
  Eigen::Vector3d ahrsRate_rad_s() const;
  std::optional<double> medianForce_m_s2(int component);
  bool wasPush(common::Time now) const;
  bool ratesDiffer();
  bool forcesDiffer();

  InertialContext context_;
  std::vector<Compared> window_;     ///< The last samples, oldest first, at most as long as the longest window.
  std::vector<double> sorted_m_s2_;  ///< Scratch of the median.
  double thrust_over_hover_ = 1.0;
  double spread_m_s2_ = 0.0;                                ///< Of the last force that was replaced.
  std::optional<common::Time> last_, pushed_;               ///< The last sample, and the end of the last push.
  Eigen::Vector3d withheld_m_s_ = Eigen::Vector3d::Zero();  ///< Velocity by the samples that were replaced.
  common::Hysteresis rates_wrong_{0.0, kTrustedAgain_s}, force_wrong_{0.0, kTrustedAgain_s};
  /// What the last sample contradicts; kNone if it is left out only because of earlier ones.
  enum class Fault { kNone, kRates, kAcross, kAlong };
  Fault fault_ = Fault::kNone;
  double fault_size_ = 0.0;  ///< In deg/s or m/s^2.
};

}  // namespace swiftlet::autonomy
