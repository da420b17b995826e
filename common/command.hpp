// Commands of the operator, from the page or a tablet, and the answers. Land is always accepted. The others are
// refused, with a reason, while the vehicle lands, and when the mission or the map does not allow them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "common/given_map.hpp"
#include "common/place_names.hpp"
#include "common/polygon.hpp"

namespace swiftlet::common {

struct HoldCommand {};
struct ResumeCommand {};
struct HomeCommand {};
struct LandCommand {};
struct GoalCommand {
  /// Set by the autonomy from `goal_given_m`, if there is one.
  Eigen::Vector2d goal_map_m = Eigen::Vector2d::Zero();
  /// The place in the given map, which the goal then follows; refused while the vehicle is not localized in it.
  std::optional<Eigen::Vector2d> goal_given_m = std::nullopt;
};

/// Flies another mission, or the one that waits. The command contains the text, so that a recording needs no file.
struct StartMissionCommand {
  std::string name;  ///< The file, for messages.
  std::string xml;
  std::vector<OfferedMap> maps = {};  ///< Maps that the mission may load, with the names that it gives them.
};
/// The vehicle holds until another mission is started, or it lands.
struct StopMissionCommand {};

/// The vehicle keeps out of the area from now on.
struct KeepOutCommand {
  /// Set by the autonomy from `corners_given_m`, if there are any. It stays where it was made.
  Polygon area;
  std::vector<Eigen::Vector2d> corners_given_m = {};  ///< Places in the given map; empty: `area` lies in `map`.
};
/// Takes back all areas of KeepOutCommands; those of the mission stay.
struct ClearKeepOutCommand {};
/// What a WaitForOperator of the mission waits for.
struct GoOnCommand {};

/// Another controller takes over, without a step.
struct ControllerCommand {
  std::string controller;  ///< A word of `controller.kind` in a system profile.
};

struct OperatorCommand {
  std::uint64_t id = 0;
  std::variant<HoldCommand, ResumeCommand, HomeCommand, LandCommand, GoalCommand, StartMissionCommand,
               StopMissionCommand, KeepOutCommand, ClearKeepOutCommand, GoOnCommand, ControllerCommand>
      kind;
};

struct CommandResult {
  std::uint64_t id = 0;
  bool accepted = false;
  std::string reason;  ///< Why it was refused; of an accepted one what comes before it or next, if anything does.
};

/// For events and the page.
std::string toString(const OperatorCommand& command, const PlaceNames& names = {});

}  // namespace swiftlet::common
