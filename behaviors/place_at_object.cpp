// PlaceAtObject: where a place is that is known with respect to a recognized object, such as the door of a house (Tomic
// 2012, section "Perception": window, door and chimney are "known with respect to the house"). SUCCESS at once; FAILURE
// when the object is not known any more.
#include "behaviors/leaves.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "behaviors/flight_tick.hpp"
#include "behaviors/named_places.hpp"
#include "behaviors/openings.hpp"
#include "behaviors/ports.hpp"
#include "behaviors/tree/leaf.hpp"

namespace swiftlet::behaviors {
namespace {

using tree::PortType;

class PlaceAtObject final : public tree::Leaf {
 public:
  explicit PlaceAtObject(const tree::NodeSetup& setup)
      : Leaf(setup), object_(setup, "object"), at_(setup, "at"), place_(setup, "place") {}
  static tree::NodeManifest manifest();

 private:
  tree::Status act(tree::TickContext& context) override;
  tree::Input<std::int64_t> object_;
  tree::Input<tree::Point> at_;
  tree::Output place_;
};

tree::NodeManifest PlaceAtObject::manifest() {
  return {.id = "PlaceAtObject",
          .kind = tree::NodeKind::kAction,
          .ports = {{.name = "object",
                     .type = PortType::kInt,
                     .required = true,
                     .description = "Its number among the recognized objects, as FindHouse and FindWindow write it."},
                    {.name = "at",
                     .type = PortType::kPoint,
                     .required = true,
                     .description = "The place in the axes of the object: of a house x along the ridge towards the "
                                    "chimney's end, y to the left, z above its floor."},
                    {.name = "place",
                     .type = PortType::kPoint,
                     .direction = tree::Direction::kOutput,
                     .description = "The same place in the map frame, or in the given map in a flight with one."}},
          .description = "Tells where a place beside a recognized object is.",
          .details = "As the object is placed now: a corrected map moves both.",
          .ends = "SUCCESS at once; FAILURE when no such object is known"};
}

tree::Status PlaceAtObject::act(tree::TickContext& context) {
  const FlightTick& tick = flightTick(context);
  const auto id = object_.get();
  const auto at = at_.get();
  if (!id) return fail(context, object_.problem());
  if (!at) return fail(context, at_.problem());
  const common::RecognizedObject* object = objectWithId(*tick.flight.world, static_cast<int>(*id));
  if (object == nullptr) return fail(context, fmt::format("no object {} is known", *id));
  const auto places = NamedPlaces::in(*tick.flight.world);
  if (!places) return fail(context, places.error());
  const Eigen::Vector3d place_map_m = object->T_map_object * Eigen::Vector3d(at->x, at->y, at->z.value_or(0.0));
  if (at->z)
    place_.set(places->point(place_map_m));
  else
    place_.set(places->point(Eigen::Vector2d(place_map_m.head<2>())));
  return tree::Status::kSuccess;
}

}  // namespace

void addPlaceAtObject(tree::Registry& registry) { registry.add<PlaceAtObject>(); }

}  // namespace swiftlet::behaviors
