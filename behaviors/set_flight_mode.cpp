// SetFlightMode: what follows is flown in `mode`, wherever a behaviour names no mode of its own. SUCCESS at once.
#include "behaviors/leaves.hpp"

#include <string>

#include "behaviors/flight_tick.hpp"
#include "behaviors/ports.hpp"
#include "behaviors/tree/leaf.hpp"

namespace swiftlet::behaviors {
namespace {

class SetFlightMode final : public tree::Leaf {
 public:
  explicit SetFlightMode(const tree::NodeSetup& setup) : Leaf(setup), mode_(setup, "mode") {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  tree::Input<std::string> mode_;
};

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

}  // namespace

void addSetFlightMode(tree::Registry& registry) { registry.add<SetFlightMode>(); }

}  // namespace swiftlet::behaviors
