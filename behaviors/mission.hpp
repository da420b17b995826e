// A mission: a behaviour tree read from XML, ticked at 10 to 20 Hz. It only wishes (Context::intent); the autonomy
// acts.
#pragma once

#include <memory>
#include <string>

#include "behaviors/context.hpp"
#include "behaviors/mission_limits.hpp"
#include "common/error.hpp"
#include "common/world/mission_status.hpp"

namespace swiftlet::behaviors {

struct TickResult {
  /// kRunning, kHeld (Context::hold, and the mission wishes nothing but to hold: from the first tick in which it stops
  /// for it), kDone or kFailed. After kDone and kFailed a tick does nothing.
  common::MissionState state = common::MissionState::kReady;
  std::string phase;   ///< The wish in words: "go to (3.00, -1.50)".
  std::string reason;  ///< Why it failed or holds.
};

class Mission {
 public:
  /// Throws common::InputError with every problem of the XML.
  static Mission fromFile(const std::string& path);
  /// Also throws for what could not work in flight within these limits, as checkMission has it.
  static Mission fromFile(const std::string& path, const MissionLimits& limits);
  /// `name` stands for the file in messages.
  static Mission fromText(const std::string& text, const std::string& name);
  Mission(Mission&&) noexcept;
  Mission& operator=(Mission&&) noexcept;
  ~Mission();

  TickResult tick(Context& context);

  /// For whoever stands above the mission and wants the vehicle for good (land, shut down): called instead of tick
  /// until it returns true, or once, when its wishes are not flown any more. Emits hold until the vehicle has stopped.
  /// The mission then stands at its beginning.
  bool letGo(Context& context);

  common::TreeView view() const;
  /// The mission has an OperatorCommand: goals and home are flown instead of refused.
  bool acceptsGoals() const;
  /// The ID of the main tree.
  const std::string& name() const;

 private:
  struct Impl;
  explicit Mission(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::behaviors
