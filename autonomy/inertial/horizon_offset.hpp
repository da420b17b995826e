// By how much the horizon of the AHRS, which the autopilot flies by, lies beside the estimated one.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/time.hpp"

namespace swiftlet::autonomy {

/// An AHRS errs by about a degree, for a quarter of a minute in one direction, and leans while the vehicle accelerates.
/// The estimate, which the laser supports, errs by a fifth of that. The error turns with the vehicle, so that an
/// integral over the world's axes has to learn it again after each turn. One thread.
class HorizonOffset {
 public:
  /// The attitudes at the time of one inertial sample.
  void observe(common::Time stamp, const Eigen::Quaterniond& ahrs, const Eigen::Quaterniond& estimated);

  /// Roll and pitch (rad) of the AHRS less the estimated ones; zero before the first sample.
  const Eigen::Vector2d& offset_rad() const { return offset_rad_; }

 private:
  Eigen::Vector2d offset_rad_ = Eigen::Vector2d::Zero();
  std::optional<common::Time> last_;
};

}  // namespace swiftlet::autonomy
