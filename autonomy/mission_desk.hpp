// The mission that is flown, and how another one takes its place in flight.
//
//            start                     stop, or start of another
//   waiting ------> flown ----------------------------------------> released, over some ticks
//      ^              ^                                              |                  |
//      |              +---------------- there is another ------------+                  |
//      +------------------------------------------------- there is none ----------------+
#pragma once

#include <optional>
#include <string>

#include "behaviors/mission.hpp"
#include "behaviors/mission_limits.hpp"
#include "common/command.hpp"

namespace swiftlet::autonomy {

/// One thread.
class MissionDesk {
 public:
  /// `limits`: those of the missions that the operator starts.
  MissionDesk(behaviors::Mission mission, behaviors::MissionLimits limits)
      : mission_(std::move(mission)), limits_(std::move(limits)) {}

  /// The mission begins only when the operator starts it, or another one. Call it before the first tick.
  void waitForStart() { waits_ = true; }
  /// From now on the flight has a given map, for missions that need one.
  void mapIsGiven() { limits_.has_map = true; }
  /// No mission is flown until the operator starts one.
  bool waits() const { return waits_; }
  /// No mission is flown, or will be once the vehicle has stopped, until the operator starts one.
  bool noneFollows() const { return (waits_ || leaves_) && !next_; }
  /// As Mission::waitingCommand(); nullopt of a mission that has been stopped.
  std::optional<common::OperatorCommand> waitingCommand() const;

  /// Answers the commands to start and to stop a mission; nullopt for any other.
  std::optional<common::CommandResult> take(const common::OperatorCommand& command);

  /// As Mission::tick. The mission that is left keeps the vehicle until it has stopped.
  behaviors::TickResult tick(behaviors::Context& context);

  behaviors::Mission& mission() { return mission_; }
  const behaviors::Mission& mission() const { return mission_; }

 private:
  common::CommandResult start(std::uint64_t id, const common::StartMissionCommand& command);
  common::CommandResult stop(std::uint64_t id);
  static void refuseCommands(behaviors::Context& context, const std::string& reason);

  behaviors::Mission mission_;
  behaviors::MissionLimits limits_;
  std::optional<behaviors::Mission> next_;
  bool waits_ = false;
  bool leaves_ = false;  ///< The mission is releasing control.
};

}  // namespace swiftlet::autonomy
