// Explore: SUCCESS when every remaining frontier has a reason why it is left; lying outside `bounds` is such a reason,
// being blocked for a time is not.
#include "behaviors/leaves.hpp"

#include <fmt/format.h>

#include "behaviors/explore_ports.hpp"
#include "behaviors/flight_leaf.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"

namespace swiftlet::behaviors {
namespace {

class Explore final : public IntentLeaf {
 public:
  explicit Explore(const tree::NodeSetup& setup)
      : IntentLeaf(setup), ports_(setup), coverage_min_(setup, "coverage_min") {}
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  std::string problemWith(const FlightTick& tick, const std::string& reason) const override;
  ExplorePorts ports_;
  tree::Input<double> coverage_min_;
};

/// The explored share of the free space that is known or expected: a frontier that is left promises this depth of it
/// (planning::Scout::kGainDepth_m), unless it is out of bounds.
double coverageOf(const common::MapLayer& map) {
  constexpr double kDepth_m = 2.0;
  double expected_m2 = map.explored_area_m2;
  for (const common::Frontier& frontier : *map.frontiers)
    if (frontier.reason != common::FrontierReason::kOutOfBounds) expected_m2 += kDepth_m * frontier.length_m;
  return expected_m2 > 0.0 ? map.explored_area_m2 / expected_m2 : 0.0;
}

tree::NodeManifest Explore::manifest() {
  std::vector<tree::PortManifest> ports = ExplorePorts::manifests();
  ports.push_back({.name = "coverage_min",
                   .type = tree::PortType::kDouble,
                   .default_value = "0",
                   .minimum = 0.0,
                   .maximum = 1.0,
                   .description = "FAILURE if a smaller share of the free space is explored: of what is known, and of "
                                  "2 m behind each frontier that is left."});
  return {.id = "Explore",
          .kind = tree::NodeKind::kAction,
          .ports = std::move(ports),
          .description = "Flies to frontiers of the map until nothing is left to explore.",
          .details =
              "Within `x_min;y_min;x_max;y_max` if `bounds` are given; out of the building, where too few walls tell "
              "the position, only with `leave_building=\"true\"`.",
          .ends =
              "SUCCESS when every remaining frontier has a reason; FAILURE if one is blocked only for a time, by a "
              "person in a door, until the charge is needed"};
}

std::string Explore::problemWith(const FlightTick& tick, const std::string& reason) const {
  const auto least = coverage_min_.get();
  if (!least) return coverage_min_.problem();
  const double share = coverageOf(*tick.flight.world->map);
  if (share >= *least) return {};
  return fmt::format("incomplete, {:.0f} % of the free space are explored and {:.0f} % asked for: {}", 100.0 * share,
                     100.0 * *least, reason);
}

IntentLeaf::IntentOrProblem Explore::makeIntent(const FlightTick& tick) {
  return ports_.intent(tick.mode, *tick.flight.world);
}

}  // namespace

void addExplore(tree::Registry& registry) { registry.add<Explore>(); }

}  // namespace swiftlet::behaviors
