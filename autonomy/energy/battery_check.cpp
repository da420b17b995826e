#include "autonomy/energy/battery_check.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace swiftlet::autonomy {
namespace {

/// Estimates of the charge go a little beyond their bounds.
constexpr double kBeyond = 0.05;
/// More than any flight draws between two samples, and more than a load lowers the estimate at once.
constexpr double kJump = 0.1;

}  // namespace

bool BatteryCheck::accepts(const common::BatterySample& sample) {
  std::string problem = problemWith(sample);
  const bool refused = !problem.empty();
  const common::Edge edge = refused_.update(refused, sample.stamps.arrived);
  if (edge == common::Edge::kEntered)
    log_.warn(sample.stamps.arrived, "supervisor", "battery samples rejected, the last good values are kept",
              std::move(problem));
  if (edge == common::Edge::kLeft) log_.info(sample.stamps.arrived, "supervisor", "battery samples accepted again");
  return !refused;
}

std::string BatteryCheck::problemWith(const common::BatterySample& sample) {
  if (!std::isfinite(sample.voltage_v) || !std::isfinite(sample.remaining))
    return "its voltage or its charge is not a finite number";
  if (sample.voltage_v <= 0.0) return fmt::format("its voltage is {:.1f} V", sample.voltage_v);
  if (sample.remaining < -kBeyond || sample.remaining > 1.0 + kBeyond)
    return fmt::format("its charge is {:.0f} %", 100.0 * sample.remaining);
  const bool jumps = used_ && std::abs(sample.remaining - *used_) > kJump;
  const bool confirmed = jumped_to_ && std::abs(sample.remaining - *jumped_to_) <= kJump;
  if (jumps && !confirmed) {
    jumped_to_ = sample.remaining;
    return fmt::format("its charge jumps from {:.0f} to {:.0f} %", 100.0 * *used_, 100.0 * sample.remaining);
  }
  used_ = sample.remaining;
  jumped_to_.reset();
  return {};
}

}  // namespace swiftlet::autonomy
