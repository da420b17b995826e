#include "control/gains.hpp"

#include <algorithm>
#include <functional>

#include "common/check.hpp"
#include "common/config_numbers.hpp"

namespace swiftlet::control {
namespace {

using common::config::Bounds;

using Visit = std::function<void(const std::string& name, double& value, const Bounds& bounds)>;

/// The numbers of a law's own section: no counts, and nothing of the sections in it.
void visitGains(FlightController::Config& config, const Visit& visit) {
  common::config::NumberVisitor visitor(
      [&visit](const std::string& key, double& value, const Bounds& bounds, bool whole) {
        if (!whole && key.find('.') == std::string::npos) visit(key, value, bounds);
      });
  switch (config.controller.kind) {
    case ControllerKind::kCascadedPid:
      return config.controller.cascaded_pid.describe(visitor);
    case ControllerKind::kVoltagePid:
      return config.controller.voltage_pid.describe(visitor);
    case ControllerKind::kLqr:
      return config.controller.lqr.describe(visitor);
    case ControllerKind::kSlidingMode:
      return config.controller.sliding_mode.describe(visitor);
    case ControllerKind::kSwiftlet:
      return config.position.describe(visitor);
  }
}

}  // namespace

std::string sectionOfGains(ControllerKind kind) {
  return kind == ControllerKind::kSwiftlet ? "position" : std::string("controller.") + toString(kind);
}

std::vector<Gain> gainsOf(const FlightController::Config& config) {
  FlightController::Config copy = config;
  std::vector<Gain> gains;
  visitGains(copy, [&](const std::string& name, double& value, const Bounds& bounds) {
    if (value > 0.0) gains.push_back({name, value, bounds});
  });
  return gains;
}

FlightController::Config withGains(FlightController::Config config, const std::vector<Gain>& gains) {
  std::size_t set = 0;
  visitGains(config, [&](const std::string& name, double& value, const Bounds&) {
    const auto found = std::find_if(gains.begin(), gains.end(), [&](const Gain& gain) { return gain.name == name; });
    if (found == gains.end()) return;
    value = found->value;
    ++set;
  });
  SWIFTLET_CHECK(set == gains.size(), set, gains.size());
  return config;
}

}  // namespace swiftlet::control
