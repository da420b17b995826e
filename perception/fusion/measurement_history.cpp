#include "perception/fusion/measurement_history.hpp"

#include <algorithm>
#include <tuple>

namespace swiftlet::perception::fusion {
namespace {

bool before(const Measurement& a, const Measurement& b) {
  const auto key = [](const Measurement& m) {
    return std::tuple(m.stamp, m.kind, m.from, m.pose.x_m, m.pose.y_m, m.pose.yaw_rad, m.value, m.covariance(0, 0),
                      m.pose3.position_m.x(), m.pose3.position_m.y(), m.pose3.position_m.z());
  };
  return key(a) < key(b);
}

}  // namespace

MeasurementHistory::MeasurementHistory(std::size_t capacity) : capacity_(capacity) { measurements_.reserve(capacity); }

bool MeasurementHistory::insert(const Measurement& measurement) {
  if (measurements_.size() >= capacity_) return false;
  measurements_.insert(std::upper_bound(measurements_.begin(), measurements_.end(), measurement, before), measurement);
  return true;
}

void MeasurementHistory::dropUntil(common::Time time) {
  const auto first_kept =
      std::find_if(measurements_.begin(), measurements_.end(), [time](const Measurement& m) { return m.stamp > time; });
  // Erased in bulk: moving the rest for every IMU sample would cost more than the search.
  if (first_kept - measurements_.begin() >= 32) measurements_.erase(measurements_.begin(), first_kept);
}

std::span<const Measurement> MeasurementHistory::within(common::Time after, common::Time until) const {
  const auto later = [](common::Time time, const Measurement& m) { return time < m.stamp; };
  const auto begin = std::upper_bound(measurements_.begin(), measurements_.end(), after, later);
  const auto end = std::upper_bound(begin, measurements_.end(), until, later);
  return {begin, end};
}

bool MeasurementHistory::holdsClone(common::Time time) const {
  return std::any_of(measurements_.begin(), measurements_.end(),
                     [time](const Measurement& m) { return m.kind == MeasurementKind::kClone && m.stamp == time; });
}

}  // namespace swiftlet::perception::fusion
