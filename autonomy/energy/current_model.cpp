#include "autonomy/energy/current_model.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::autonomy {
namespace {

/// Long enough to hold stops and long legs, short against the fall of the voltage, which raises the current.
constexpr double kMemory_s = 60.0;
/// Variance of the speed, (m/s)^2, from which the slope is used.
constexpr double kTellingVariance = 0.02;

}  // namespace

void CurrentModel::add(double current_a, double speed_m_s, double dt_s) {
  if (!std::isfinite(current_a) || !std::isfinite(speed_m_s)) return;
  const double keep = std::exp(-std::max(0.0, dt_s) / kMemory_s);
  // The first sample of a flight may come without a duration. It must count for little, because the motors have
  // only begun to carry the vehicle.
  constexpr double kFirst = 1e-6;
  const double weight = weight_ > 0.0 ? 1.0 - keep : std::max(kFirst, 1.0 - keep);
  const auto average = [&](double& sum, double next) { sum = keep * sum + weight * next; };
  average(weight_, 1.0);
  average(speed_, speed_m_s);
  average(current_, current_a);
  average(speed2_, speed_m_s * speed_m_s);
  average(product_, speed_m_s * current_a);
}

double CurrentModel::drawn_as(double duration_s, double length_m) const {
  if (!(weight_ > 0.0)) return 0.0;
  const double speed = speed_ / weight_, current = current_ / weight_;
  const double variance = std::max(0.0, speed2_ / weight_ - speed * speed);
  const double slope = (product_ / weight_ - speed * current) / (variance + kTellingVariance);
  return std::max(0.0, (current - slope * speed) * duration_s + slope * length_m);
}

}  // namespace swiftlet::autonomy
