// Which odometry the filter uses: all that there are, or the best alone.
//
// Tomic 2012, "Visual Odometry": under bad conditions a sensor's measurements have outliers that no gate finds, so its
// covariance is not valid, and the sensor with the smallest covariance is taken for the one that suits the
// surroundings.
//
//            vision clearly better for a while, or the laser measures nothing
//   laser  ------------------------------------------------------------------>  vision
//          <------------------------------------------------------------------
//            laser clearly better for a while, or vision measures nothing
//
// A sensor measures nothing when it says so in two turns, or falls silent. From the first turn in which it brings
// nothing the other one stands in for it, if that measures: its variance is then the smallest that there is. That is no
// switch yet, and ends with the next measurement of the sensor that is used.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <Eigen/Core>

#include "common/hysteresis.hpp"
#include "common/time.hpp"
#include "perception/fusion/measurement.hpp"

namespace swiftlet::perception {

/// `best` is the paper's rule. With `all`, ours, the filter weighs both by their covariances.
enum class OdometryRule { kAll, kBest };
const char* toString(OdometrySource source);

/// The standard deviation of a relative pose, by which sensors are compared: that of the horizontal position along its
/// least certain direction, in metres, with the yaw counted as what it moves at 1 m. Infinite where the scene hides a
/// motion. `measurement` is a relative pose, planar or in space; in space the axes are those of the body.
double deviation_m(const Measurement& measurement);

/// A change of the sensor.
struct OdometrySwitch {
  OdometrySource from, to;
  double from_m, to_m;  ///< Standard deviations; infinite for a sensor that measures nothing.
};

/// One thread. Plain data.
class OdometryChoice {
 public:
  static constexpr double kNothing = std::numeric_limits<double>::infinity();

  explicit OdometryChoice(OdometryRule rule) : rule_(rule) {}

  /// A sensor has measured with that standard deviation, or nothing (kNothing), in its turn. The switch that follows.
  std::optional<OdometrySwitch> measured(OdometrySource source, double deviation_m, common::Time now);
  /// Whether the filter uses what it measures now.
  bool uses(OdometrySource source, common::Time now) const;

 private:
  /// Three pairs at 4 Hz: pictures that are blurred in turns with sharp ones do not make the sensors take turns.
  static constexpr double kSettled_s = 0.7;
  struct Sensor {
    double deviation_m = kNothing;  ///< As of `at`; a single turn that brings nothing does not change it.
    std::optional<common::Time> at;
    bool brought_nothing = false;  ///< In its last turn.
    std::optional<common::Time> last_turn;
    double period_s = 0.0;  ///< From turn to turn; 0 before the second.

    bool isOverdue(common::Time now) const;
  };
  double presentDeviation_m(OdometrySource source, common::Time now) const;

  OdometryRule rule_;
  OdometrySource used_ = OdometrySource::kLaser;  ///< A flight begins with it: near the ground cameras see too little.
  std::array<Sensor, kOdometrySources> sensors_;
  common::Hysteresis other_better_{kSettled_s};  ///< Clearly, though the used one measures.
};

}  // namespace swiftlet::perception
