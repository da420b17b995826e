#include "behaviors/set_flight_mode.hpp"

#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {

tree::NodeManifest SetFlightMode::manifest() {
  return {.id = "SetFlightMode",
          .kind = tree::NodeKind::kAction,
          .ports = {choicePort("mode", common::kFlightModes, "How fast and how closely paths are flown.")},
          .description = "Sets the flight mode of what follows.",
          .details =
              "Where a behaviour names none of its own; at first it is fast. Brisk flies at 1.2 m/s where thrust and "
              "the distance to what is near permit.",
          .ends = "SUCCESS at once",
          .may_fail = false};
}

tree::Status SetFlightMode::act(tree::TickContext& context) {
  const auto mode = mode_.get();
  if (!mode) return fail(context, mode_.problem());
  flightTick(context).mode = chosenOf(common::kFlightModes, *mode);
  return tree::Status::kSuccess;
}

}  // namespace swiftlet::behaviors
