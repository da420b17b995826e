// FlyThroughWindow: through a recognized window by visual servoing (autonomy/maneuvers/fly_through.cpp). SUCCESS behind
// it; FAILURE, before it, when it is lost or seen closed before the hull is in it.
#include "behaviors/leaves.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/openings.hpp"
#include "behaviors/ports.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::PortType;

class FlyThroughWindow final : public IntentLeaf {
 public:
  explicit FlyThroughWindow(const tree::NodeSetup& setup);
  static tree::NodeManifest manifest();

 private:
  void onStart(tree::TickContext& context) override;
  IntentOrProblem makeIntent(const FlightTick& tick) override;

  tree::Input<std::int64_t> window_;
  tree::Input<double> before_m_, behind_m_, clearance_m_;
  /// Of the flight, in `map`; it stays where the vehicle is interrupted in the window.
  std::optional<double> heading_rad_;
};

tree::NodeManifest FlyThroughWindow::manifest() {
  return {.id = "FlyThroughWindow",
          .kind = tree::NodeKind::kAction,
          .ports = {{.name = "window",
                     .type = PortType::kInt,
                     .required = true,
                     .minimum = 1.0,
                     .description = "Number of the window among the recognized objects, as FindWindow writes it."},
                    {.name = "before_m",
                     .type = PortType::kDouble,
                     .default_value = "1.6",
                     .minimum = 0.5,
                     .maximum = 5.0,
                     .description = "From the wall to the place from which it flies through."},
                    {.name = "behind_m",
                     .type = PortType::kDouble,
                     .default_value = "1.2",
                     .minimum = 0.5,
                     .maximum = 5.0,
                     .description = "From the wall to the place behind it where it ends."},
                    clearancePort()},
          .description = "Flies through a window that was found.",
          .details =
              "To a place before it, on its normal, and through its middle, at most 0.4 m/s fast and at the height of "
              "the middle. The path is laid anew as the window is seen from moment to moment. It turns back when it "
              "is lost, or seen closed, before the hull is in it.",
          .ends = "SUCCESS behind it; FAILURE before it",
          .traits = LeafTraits{.needs_camera = true}};
}

FlyThroughWindow::FlyThroughWindow(const tree::NodeSetup& setup)
    : IntentLeaf(setup),
      window_(setup, "window"),
      before_m_(setup, "before_m"),
      behind_m_(setup, "behind_m"),
      clearance_m_(setup, "clearance_m") {}

void FlyThroughWindow::onStart(tree::TickContext& context) {
  IntentLeaf::onStart(context);
  heading_rad_.reset();
}

IntentLeaf::IntentOrProblem FlyThroughWindow::makeIntent(const FlightTick& tick) {
  const auto window = window_.get();
  const auto before_m = before_m_.get(), behind_m = behind_m_.get(), clearance_m = clearance_m_.get();
  if (!window) return tl::unexpected(window_.problem());
  if (!before_m) return tl::unexpected(before_m_.problem());
  if (!behind_m) return tl::unexpected(behind_m_.problem());
  if (!clearance_m) return tl::unexpected(clearance_m_.problem());
  const common::World& world = *tick.flight.world;
  const common::RecognizedObject* object = objectWithId(world, static_cast<int>(*window));
  if (object == nullptr) return tl::unexpected(fmt::format("no object {} is known", *window));
  if (!heading_rad_) {
    const Eigen::Vector2d through = directionThrough(*object, world.vehicle->state.T_map_body_planar().position_m());
    heading_rad_ = std::atan2(through.y(), through.x());
  }
  common::FlyThroughIntent intent;
  intent.object_id = object->id;
  intent.what = object->what;
  intent.heading_rad = *heading_rad_;
  intent.before_m = *before_m;
  intent.behind_m = *behind_m;
  intent.clearance_m = *clearance_m;
  return intent;
}

}  // namespace

void addFlyThroughWindow(tree::Registry& registry) { registry.add<FlyThroughWindow>(); }

}  // namespace swiftlet::behaviors
