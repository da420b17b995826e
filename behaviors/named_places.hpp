// Where the places that a mission names lie in `map`: in a flight with a given map they are places of that map, and of
// `map` itself otherwise.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "behaviors/ports.hpp"
#include "behaviors/tree/value.hpp"
#include "common/geometry.hpp"
#include "common/intent.hpp"
#include "common/polygon.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"

namespace swiftlet::behaviors {

/// An immutable value, valid as long as the localization does not move the given map.
class NamedPlaces {
 public:
  /// Returns the reason while the flight has a given map and is not localized in it.
  static tl::expected<NamedPlaces, std::string> in(const common::World& world) {
    const common::MapLayer& map = *world.map;
    if (map.localization && !map.T_map_given)
      return tl::unexpected(std::string("its place in the given map is not known"));
    return NamedPlaces(map.localization ? map.T_map_given : std::nullopt);
  }

  /// True if the places are those of a given map.
  bool given() const { return T_map_given_.has_value(); }
  common::Pose2 T_map_named() const { return T_map_given_.value_or(common::Pose2{}); }
  Eigen::Vector2d inMap_m(const Eigen::Vector2d& named_m) const {
    return T_map_given_ ? *T_map_given_ * named_m : named_m;
  }
  Eigen::Vector2d inMap_m(const tree::Point& named) const { return inMap_m(Eigen::Vector2d(named.x, named.y)); }
  /// The point by which a mission names a place of `map`; one of the plane has no height.
  tree::Point point(const Eigen::Vector2d& place_map_m) const {
    const Eigen::Vector2d named_m = T_map_named().inverse() * place_map_m;
    return {named_m.x(), named_m.y(), std::nullopt};
  }
  tree::Point point(const Eigen::Vector3d& place_map_m) const {
    tree::Point named = point(Eigen::Vector2d(place_map_m.head<2>()));
    named.z = place_map_m.z();
    return named;
  }
  double yawInMap_rad(double named_deg) const {
    const double named_rad = named_deg * common::kRadPerDeg;
    return T_map_given_ ? common::wrapAngle(T_map_given_->yaw_rad + named_rad) : named_rad;
  }
  common::Polygon inMap(const tree::Points& named) const {
    common::Polygon polygon;
    for (const tree::Point& point : named.points) polygon.corners_map_m.push_back(inMap_m(point));
    return polygon;
  }

 private:
  explicit NamedPlaces(std::optional<common::Pose2> T_map_given) : T_map_given_(T_map_given) {}

  std::optional<common::Pose2> T_map_given_;
};

/// The localization has moved the given map, and with it the goal, or has lost it.
inline bool hasMoved(const common::GoToIntent& intent, const common::World& world) {
  // Less than the tolerance of a goal, more than the noise of a match (docs/decisions/localization.md#054).
  constexpr double kMoved_m = 0.03;
  if (!intent.goal_given_m) return false;
  const auto places = NamedPlaces::in(world);
  return !places || (places->inMap_m(*intent.goal_given_m) - intent.goal_map_m).norm() > kMoved_m;
}

}  // namespace swiftlet::behaviors
