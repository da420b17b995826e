#include "control/gains.hpp"

#include <algorithm>
#include <functional>

#include "common/check.hpp"

namespace swiftlet::control {
namespace {

using common::config::Bounds;

/// Visits the numbers of one section.
class NumberVisitor final : public common::config::Fields {
 public:
  using Visit = std::function<void(std::string_view name, double& value, const Bounds& bounds)>;
  explicit NumberVisitor(Visit visit) : visit_(std::move(visit)) {}

  using Fields::choice;
  void operator()(std::string_view name, double& value, const Bounds& bounds, std::string_view) override {
    visit_(name, value, bounds);
  }
  void operator()(std::string_view, int&, const Bounds&, std::string_view) override {}
  void operator()(std::string_view, bool&, std::string_view) override {}
  void operator()(std::string_view, std::string&, std::string_view) override {}
  void operator()(std::string_view, std::vector<double>&, const Bounds&, std::string_view) override {}
  void operator()(std::string_view, std::vector<std::string>&, std::string_view) override {}
  void choice(std::string_view, int&, const std::vector<std::string>&, std::string_view) override {}

 protected:
  bool beginSection(std::string_view, std::string_view) override { return false; }
  void endSection(std::vector<std::string>) override {}
  int beginList(std::string_view, int, std::string_view) override { return 0; }
  void beginItem(int) override {}
  void endList() override {}

 private:
  Visit visit_;
};

void visitGains(FlightController::Config& config, NumberVisitor::Visit visit) {
  NumberVisitor visitor(std::move(visit));
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
  visitGains(copy, [&](std::string_view name, double& value, const Bounds& bounds) {
    if (value > 0.0) gains.push_back({std::string(name), value, bounds});
  });
  return gains;
}

FlightController::Config withGains(FlightController::Config config, const std::vector<Gain>& gains) {
  std::size_t set = 0;
  visitGains(config, [&](std::string_view name, double& value, const Bounds&) {
    const auto found = std::find_if(gains.begin(), gains.end(), [&](const Gain& gain) { return gain.name == name; });
    if (found == gains.end()) return;
    value = found->value;
    ++set;
  });
  SWIFTLET_CHECK(set == gains.size(), set, gains.size());
  return config;
}

}  // namespace swiftlet::control
