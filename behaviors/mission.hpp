// A mission: a behaviour tree read from XML, ticked at 10 to 20 Hz. It only emits intents (Context::intent); the
// autonomy executes them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "behaviors/context.hpp"
#include "behaviors/mission_limits.hpp"
#include "behaviors/registry.hpp"
#include "common/error.hpp"
#include "common/world/mission_status.hpp"

namespace swiftlet::behaviors {

struct TickResult {
  /// kRunning, kHeld, kDone or kFailed. kHeld means that Context::hold is set and the mission emits only hold, from the
  /// first tick in which it stops for it. After kDone and kFailed a tick does nothing.
  common::MissionState state = common::MissionState::kReady;
  std::string phase;   ///< The intent in words: "go to (3.00, -1.50)".
  std::string reason;  ///< Why the mission failed or holds.
};

/// The answer to what is accepted during a hold.
std::string flownAfterHold(const std::string& hold_reason);

class Mission {
 public:
  /// Of nodes of these types. Throws common::InputError with every problem of the XML.
  static Mission fromFile(const std::string& path, const NodeTypes& types = missionNodes());
  /// Also throws for anything that cannot work in flight within these limits, by the rules of checkMission.
  static Mission fromFile(const std::string& path, const MissionLimits& limits,
                          const NodeTypes& types = missionNodes());
  /// Messages use `name` as the file.
  static Mission fromText(const std::string& text, const std::string& name, const NodeTypes& types = missionNodes());
  static Mission fromText(const std::string& text, const std::string& name, const MissionLimits& limits,
                          const NodeTypes& types = missionNodes());
  Mission(Mission&&) noexcept;
  Mission& operator=(Mission&&) noexcept;
  ~Mission();

  TickResult tick(Context& context);

  /// Ends the mission's control of the vehicle (land, shut down). Call it instead of tick until it returns true, or
  /// once if its intents are not flown any more. Emits hold until the vehicle has stopped. Afterwards the mission is
  /// reset.
  bool letGo(Context& context);

  /// Its nodes with their statuses, ports, reasons and durations. The reference is valid until the next tick or view.
  const common::TreeView& view() const;
  /// The ids of its intents rise from where those of the mission that it replaces ended.
  void continueIntentsOf(const Mission& before);
  /// The mission has an OperatorCommand: goals and home commands are flown instead of refused.
  bool acceptsGoals() const;
  /// The operator's goal or home command that the mission flies to, now or after what it does now.
  std::optional<common::OperatorCommand> waitingCommand() const;
  /// What a WaitForOperator waits for; empty while none waits.
  std::string question() const;
  /// The greatest height that the mission allows above the take-off floor, if one of its TakeOffs names one.
  std::optional<double> maxHeight_m() const;
  /// Whether the vehicle flies home before it lands if the mission fails.
  bool fliesHomeOnFailure() const;
  /// The maps that its LoadMaps name, as they name them; each once.
  std::vector<std::string> mapFiles() const;
  /// What it was read with.
  const NodeTypes& types() const;
  /// The ID of the main tree.
  const std::string& name() const;

 private:
  struct Impl;
  explicit Mission(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::behaviors
