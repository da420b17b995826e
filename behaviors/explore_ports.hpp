// The ports of a leaf that explores.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "behaviors/named_places.hpp"
#include "behaviors/ports.hpp"
#include "common/intent.hpp"

namespace swiftlet::behaviors {

class ExplorePorts {
 public:
  static std::vector<tree::PortManifest> manifests() {
    return {clearancePort(),
            {.name = "bounds",
             .type = tree::PortType::kRectangle,
             .description = "In the map frame, whose origin is the take-off pose, or in a given map; what lies "
                            "outside is left unexplored and is not flown to. Not given: no bounds."},
            {.name = "leave_building",
             .type = tree::PortType::kBool,
             .default_value = "false",
             .description = "Explore also where the laser would see too little to know the position, as outside "
                            "an open door."}};
  }
  /// The manifest must have those ports.
  explicit ExplorePorts(const tree::NodeSetup& setup)
      : clearance_m_(setup, "clearance_m"), bounds_(setup, "bounds"), leave_building_(setup, "leave_building") {}

  /// The intent to explore in that mode; or which port has no value, or that there are bounds in a given map whose pose
  /// is not known.
  tl::expected<common::ExploreIntent, std::string> intent(common::FlightMode mode, const common::World& world) const {
    const auto clearance_m = clearance_m_.get();
    if (!clearance_m) return tl::unexpected(clearance_m_.problem());
    const auto leave_building = leave_building_.get();
    if (!leave_building) return tl::unexpected(leave_building_.problem());
    common::ExploreIntent intent{*clearance_m, std::nullopt, *leave_building, mode};
    if (bounds_.given()) {
      const auto bounds = bounds_.get();
      if (!bounds) return tl::unexpected(bounds_.problem());
      const auto places = NamedPlaces::in(world);
      if (!places) return tl::unexpected(places.error());
      intent.bounds =
          common::MapBounds{{bounds->x_min, bounds->y_min}, {bounds->x_max, bounds->y_max}, places->T_map_named()};
    }
    return intent;
  }

 private:
  tree::Input<double> clearance_m_;
  tree::Input<tree::Rectangle> bounds_;
  tree::Input<bool> leave_building_;
};

}  // namespace swiftlet::behaviors
