#include "control/controller_choice.hpp"

#include <algorithm>

#include "common/config_fields.hpp"

namespace swiftlet::control {

const std::vector<std::string>& controllerWords() {
  static const std::vector<std::string> words = {"swiftlet", "cascaded_pid", "voltage_pid", "lqr", "sliding_mode"};
  return words;
}

const char* toString(ControllerKind kind) { return controllerWords()[static_cast<std::size_t>(kind)].c_str(); }

std::optional<ControllerKind> controllerNamed(std::string_view word) {
  const auto& words = controllerWords();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return std::nullopt;
  return static_cast<ControllerKind>(found - words.begin());
}

void ControllerChoiceConfig::describe(common::config::Fields& fields) {
  fields.choice("kind", kind, controllerWords(),
                "Which controller flies; lqr needs a vehicle_model of `swiftlet identify`.");
  fields.section("cascaded_pid", cascaded_pid, "Settings of the kind cascaded_pid.");
  fields.section("voltage_pid", voltage_pid, "Settings of the kind voltage_pid.");
  fields.section("lqr", lqr, "Settings of the kind lqr.");
  fields.section("sliding_mode", sliding_mode, "Settings of the kind sliding_mode.");
}

std::unique_ptr<Controller> makeController(ControllerKind kind, const ControllerChoiceConfig& choice,
                                           const PositionController::Config& position,
                                           const common::VehicleConfig& vehicle, const VehicleModel* model) {
  switch (kind) {
    case ControllerKind::kCascadedPid:
      return std::make_unique<CascadedPid>(choice.cascaded_pid, vehicle);
    case ControllerKind::kVoltagePid:
      return std::make_unique<VoltagePid>(choice.voltage_pid, vehicle, model);
    case ControllerKind::kLqr:
      if (model == nullptr || !model->hasAxes() || !Lqr::problemsOf(choice.lqr, *model).empty()) return nullptr;
      return std::make_unique<Lqr>(choice.lqr, vehicle, *model);
    case ControllerKind::kSlidingMode:
      return std::make_unique<SlidingMode>(choice.sliding_mode, vehicle);
    case ControllerKind::kSwiftlet:
      break;
  }
  return std::make_unique<PositionController>(position, vehicle);
}

}  // namespace swiftlet::control
