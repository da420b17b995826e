// Inspect: orbits `point` at `radius_m` with the camera on it. SUCCESS after `turns`; parts of the circle that are not
// free are left out; FAILURE when no part is. The place of the point in a given map is looked up once, when it
// begins.
#include "behaviors/leaves.hpp"

#include <string>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::PortType;

class Inspect final : public IntentLeaf {
 public:
  explicit Inspect(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  IntentOrProblem makeIntent(const FlightTick& tick) override;
  tree::Input<tree::Point> point_;
  tree::Input<double> radius_m_, turns_, height_m_, clearance_m_;
  tree::Input<std::string> mode_;
};

tree::NodeManifest Inspect::manifest() {
  return {.id = "Inspect",
          .kind = tree::NodeKind::kAction,
          .ports = {placePort("point"),
                    {.name = "radius_m",
                     .type = PortType::kDouble,
                     .default_value = "1.5",
                     .minimum = 0.3,
                     .maximum = 20.0,
                     .description = "Radius of the circle about the point that the vehicle's centre flies."},
                    {.name = "turns",
                     .type = PortType::kDouble,
                     .default_value = "1",
                     .minimum = 0.1,
                     .maximum = 20.0,
                     .description = "Part of the circle that is flown, counter-clockwise."},
                    {.name = "height_m",
                     .type = PortType::kDouble,
                     .description =
                         "Height of the vehicle above the take-off floor. Not given: where the camera's axis meets "
                         "the point, or the present height where the point has no z."},
                    clearancePort(),
                    modePort()},
          .description = "Orbits a point with the camera on it.",
          .details =
              "Counter-clockwise, the camera's axis on it, at the height where the axis meets a point with z; parts of "
              "the circle that are not free are left out.",
          .ends = "SUCCESS after `turns`; FAILURE when no place of the circle is free",
          .traits = LeafTraits{.needs_camera = true}};
}

Inspect::Inspect(const tree::NodeSetup& setup)
    : IntentLeaf(setup),
      point_(setup, "point"),
      radius_m_(setup, "radius_m"),
      turns_(setup, "turns"),
      height_m_(setup, "height_m"),
      clearance_m_(setup, "clearance_m"),
      mode_(setup, "mode") {}

IntentLeaf::IntentOrProblem Inspect::makeIntent(const FlightTick& tick) {
  const auto point = point_.get();
  const auto radius_m = radius_m_.get(), turns = turns_.get(), clearance_m = clearance_m_.get();
  const auto height_m = height_m_.get();
  const auto mode = modeOr(mode_, tick.mode);
  if (!point) return tl::unexpected(point_.problem());
  if (!radius_m) return tl::unexpected(radius_m_.problem());
  if (!turns) return tl::unexpected(turns_.problem());
  if (!clearance_m) return tl::unexpected(clearance_m_.problem());
  if (height_m_.given() && !height_m) return tl::unexpected(height_m_.problem());
  if (!mode) return tl::unexpected(mode_.problem());
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return tl::unexpected(places.error());
  common::Goal place{.place_map_m = places->inMap_m(*point), .height_m = height_m, .tolerance_m = 0, .clearance_m = 0};
  const auto verdict = common::judgeGoal(place, tick.flight.goal_limits, nullptr);
  if (!verdict) return tl::unexpected(verdict.error().text);
  return common::InspectIntent{*verdict, point->z, *radius_m, *turns, height_m, *clearance_m, *mode};
}

}  // namespace

void addInspect(tree::Registry& registry) { registry.add<Inspect>(); }

}  // namespace swiftlet::behaviors
