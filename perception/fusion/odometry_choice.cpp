#include "perception/fusion/odometry_choice.hpp"

#include <algorithm>
#include <cmath>

#include "common/small_matrices.hpp"

namespace swiftlet::perception {
namespace {

/// The other sensor is used when its standard deviation is below this share of that of the present one, so half its
/// variance: two that are alike do not take turns.
constexpr double kClearlyBetter = 0.7;
/// Without a measurement for so long a sensor measures nothing: two periods of the slowest camera, at 3 Hz, and the
/// jitter of its link. Within it two scans of a laser at 10 Hz may be lost.
constexpr double kSilent_s = 0.7;
/// A sensor that measures nothing in one turn may in the next: one pair at 3 Hz, with the jitter of its link.
constexpr double kMissed_s = 0.4;
/// A turn is overdue after this many of the sensor's periods, as the jitter of a link is less than a tenth of one, but
/// not within what inertia carries well. The sensor that stands in has its own turn to come before the filter misses a
/// pose (FusionConfig::horizontal_timeout_s).
constexpr double kOverdue = 1.2, kLeastOverdue_s = 0.25;
/// By how much the period may grow from turn to turn: one that is lost does not count as the period.
constexpr double kSlower = 1.1;

}  // namespace

const char* toString(OdometrySource source) { return source == OdometrySource::kLaser ? "laser" : "vision"; }

double deviation_m(const Measurement& measurement) {
  constexpr double kArm_m = 1.0;
  if (measurement.kind == MeasurementKind::kRelativePose3) {
    const auto& covariance = measurement.covariance6;
    const Eigen::Vector2d position_m2 = common::symmetricEigenvalues(Eigen::Matrix2d(covariance.topLeftCorner<2, 2>()));
    return std::sqrt(position_m2[1] + kArm_m * kArm_m * covariance(5, 5));
  }
  if (measurement.unobservable_motion) return OdometryChoice::kNothing;
  const Eigen::Vector2d position_m2 =
      common::symmetricEigenvalues(Eigen::Matrix2d(measurement.covariance.topLeftCorner<2, 2>()));
  return std::sqrt(position_m2[1] + kArm_m * kArm_m * measurement.covariance(2, 2));
}

bool OdometryChoice::Sensor::isOverdue(common::Time now) const {
  return !last_turn || (now - *last_turn).seconds() > std::max(kLeastOverdue_s, kOverdue * period_s);
}

bool OdometryChoice::uses(OdometrySource source, common::Time now) const {
  if (rule_ == OdometryRule::kAll || source == used_) return true;
  const Sensor& used = sensors_[static_cast<std::size_t>(used_)];
  const Sensor& other = sensors_[static_cast<std::size_t>(source)];
  const bool measures = !other.brought_nothing && std::isfinite(other.deviation_m);
  return measures && (used.brought_nothing || used.isOverdue(now));
}

double OdometryChoice::presentDeviation_m(OdometrySource source, common::Time now) const {
  const Sensor& sensor = sensors_[static_cast<std::size_t>(source)];
  return sensor.at && (now - *sensor.at).seconds() <= kSilent_s ? sensor.deviation_m : kNothing;
}

std::optional<OdometrySwitch> OdometryChoice::measured(OdometrySource source, double deviation_m, common::Time now) {
  Sensor& sensor = sensors_[static_cast<std::size_t>(source)];
  sensor.brought_nothing = !std::isfinite(deviation_m);
  if (sensor.last_turn) {
    const double since_s = (now - *sensor.last_turn).seconds();
    sensor.period_s = sensor.period_s > 0.0 ? std::min(since_s, kSlower * sensor.period_s) : since_s;
  }
  sensor.last_turn = now;
  const bool missed_one = sensor.brought_nothing && sensor.at && (now - *sensor.at).seconds() <= kMissed_s;
  if (!missed_one) {
    sensor.deviation_m = deviation_m;
    sensor.at = now;
  }
  if (rule_ == OdometryRule::kAll) return std::nullopt;
  const OdometrySource other = used_ == OdometrySource::kLaser ? OdometrySource::kVision : OdometrySource::kLaser;
  const double used_m = presentDeviation_m(used_, now), other_m = presentDeviation_m(other, now);
  const bool better = std::isfinite(other_m) && other_m < kClearlyBetter * used_m;
  other_better_.update(better, now);
  if (!better || (std::isfinite(used_m) && !other_better_.active())) return std::nullopt;
  other_better_.reset();
  const OdometrySwitch change{used_, other, used_m, other_m};
  used_ = other;
  return change;
}

}  // namespace swiftlet::perception
