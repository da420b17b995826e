// A mission: a behaviour tree read from XML, ticked at 10 to 20 Hz. It only wishes (Context::intent); the autonomy
// acts.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "behaviors/context.hpp"
#include "behaviors/tree/registry.hpp"
#include "common/error.hpp"
#include "common/world/mission_status.hpp"

namespace swiftlet::behaviors {

/// What the rest of the system allows a mission to ask for.
struct MissionLimits {
  /// Why the reactive layer would not let the vehicle fly with a clearance (m, between hull and obstacle); empty when
  /// it would. No function: every clearance can be flown.
  std::function<std::vector<std::string>(double clearance_m)> clearance_problems = {};
  /// Above the take-off floor.
  double max_height_m = 10.0;
  bool has_map = true;  ///< Of the place: what finds itself in one needs it.
};

struct TickResult {
  /// kRunning, kHeld (Context::hold, and the mission wishes nothing but to hold: from the first tick in which it stops
  /// for it), kDone or kFailed. After kDone and kFailed a tick does nothing.
  common::MissionState state = common::MissionState::kReady;
  std::string phase;   ///< The wish in words: "go to (3.00, -1.50)".
  std::string reason;  ///< Why it failed or holds.
};

class Mission {
 public:
  /// Throws common::InputError with every problem of the file.
  static Mission fromFile(const std::string& path);
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

/// Every problem of a mission file, without flying it: those of the XML, and what could not work in flight (flies
/// before it takes off, a clearance the reactive layer forbids, a branch that never gets the vehicle). Empty: it is
/// sound.
std::vector<common::Problem> checkMission(const std::string& path, const MissionLimits& limits = {});
std::vector<common::Problem> checkMissionText(const std::string& text, const std::string& name,
                                              const MissionLimits& limits = {});

/// The engine's nodes and the behaviours.
const tree::Registry& missionRegistry();

}  // namespace swiftlet::behaviors
