// Explore: SUCCESS when every remaining frontier has a reason why it is left; lying outside `bounds` is such a reason.
#include "behaviors/leaves.hpp"

#include "behaviors/explore_ports.hpp"
#include "behaviors/flight_leaf.hpp"

namespace swiftlet::behaviors {
namespace {

class Explore final : public IntentLeaf {
 public:
  explicit Explore(const tree::NodeSetup& setup) : IntentLeaf(setup), ports_(setup) {}
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  ExplorePorts ports_;
};

tree::NodeManifest Explore::manifest() {
  return {.id = "Explore",
          .kind = tree::NodeKind::kAction,
          .ports = ExplorePorts::manifests(),
          .description = "Flies to frontiers of the map until nothing is left to explore.",
          .details =
              "Within `x_min;y_min;x_max;y_max` if `bounds` are given; out of the building, where too few walls tell "
              "the position, only with `leave_building=\"true\"`.",
          .ends = "SUCCESS when every remaining frontier has a reason"};
}

IntentLeaf::IntentOrProblem Explore::makeIntent(const FlightTick& tick) {
  return ports_.intent(tick.mode, *tick.flight.world);
}

}  // namespace

void addExplore(tree::Registry& registry) { registry.add<Explore>(); }

}  // namespace swiftlet::behaviors
