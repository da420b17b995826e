// Carries out what the mission and the operator ask for beside the intents.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "autonomy/keep_out_zones.hpp"
#include "common/command.hpp"
#include "common/event.hpp"
#include "common/mission_request.hpp"
#include "common/time.hpp"
#include "common/world.hpp"

namespace swiftlet::autonomy {

/// One thread; called at the ticks of the behaviours.
class FlightRequests {
 public:
  explicit FlightRequests(double hull_radius_m) : keep_out_(hull_radius_m) {}

  /// Handles and answers commands about keep-out zones; every other one is for somebody else.
  std::optional<common::CommandResult> take(const common::OperatorCommand& command, const common::World& world);
  void take(const std::vector<common::MissionRequest>& requests, const common::World& world);

  const KeepOutZones& keepOut() const { return keep_out_; }
  std::vector<common::MissionAnswer> takeAnswers();
  std::vector<common::Event> takeEvents();

 private:
  std::string addZone(const common::Polygon& zone, KeepOutZones::Owner owner, const common::World& world);
  void say(common::Time now, std::string text, std::string reason);

  KeepOutZones keep_out_;
  std::vector<common::MissionAnswer> answers_;
  std::vector<common::Event> events_;
};

}  // namespace swiftlet::autonomy
