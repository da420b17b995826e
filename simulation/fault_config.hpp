// A fault of a sensor or of the battery: what goes wrong, and when: between two times, at a place, or in a phase of the
// flight.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "simulation/sensors/sensor_config.hpp"

namespace swiftlet::simulation {

enum class FaultKind {
  kSilent,      ///< No measurement arrives.
  kNan,         ///< Every number is NaN.
  kRepeat,      ///< The last good measurement is repeated, with new stamps.
  kLate,        ///< Measurements arrive `late_s` later.
  kStuck,       ///< Of the IMU: the attitude of the AHRS stays as it was, rates and specific force live.
  kBias,        ///< Of the IMU: rates and specific force are off by a constant on every axis.
  kMirror,      ///< Of the laser: the beams that the mirror deflects down return nothing.
  kBlocked,     ///< Of the laser: the beams between two angles return nothing.
  kBlack,       ///< Of a camera: colours are black, as without light; depth stays.
  kWhite,       ///< Of a camera: colours are white and nothing has depth, as in the sun.
  kFlipped,     ///< Of a camera: left and right of the pictures are exchanged.
  kOtherSize,   ///< Of a camera: pictures have half the width and half the height that they should have.
  kExchanged,   ///< Of a stereo camera: the pictures of the left and of the right camera are exchanged.
  kOneSided,    ///< Of a stereo camera: the right camera sends no picture.
  kClockJump,   ///< The clock that stamps the measurements is off by `jump_s`.
  kClockDrift,  ///< It gains `drift_s_s` in each second from the beginning of the fault on.
  kLostCell,    ///< Of the battery itself: one of its cells is short, from then on.
};
/// Whether it is a fault of a camera's pictures.
bool isOfPictures(FaultKind kind);
/// Whether it is a fault of the battery itself and not of what is measured. It never ends.
bool isOfBattery(FaultKind kind);

struct FaultConfig {
  Sensor sensor = Sensor::kLaser;
  FaultKind kind = FaultKind::kSilent;
  double from_s = 0.0;
  double to_s = 0.0;
  double late_s = 0.5;
  std::vector<double> place_world_m = {};
  double within_m = 1.0;
  std::string phase = {};
  double lasts_s = 0.0;
  double gyro_bias_deg_s = 0.0;
  double accel_bias_m_s2 = 0.0;
  double from_deg = -45.0;
  double to_deg = 45.0;
  double jump_s = 0.0;
  double drift_s_s = 0.0;

  /// Begins at a place or in a phase, and not at a time.
  bool isTriggered() const { return !place_world_m.empty() || !phase.empty(); }

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

/// What goes wrong and when, for tables and names of folders: "imu-silent-taking_off", "imu-bias+0.3m_s2-15s",
/// "imu-nan-place".
std::string nameOf(const FaultConfig& fault);

}  // namespace swiftlet::simulation
