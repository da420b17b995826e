#include "autonomy/world_builder.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "control/flight_state_machine.hpp"

namespace swiftlet::autonomy {
namespace {

/// One cell of the shipped map: a denser trail looks the same on the page.
constexpr double kShownTrailStep_m = 0.05;
/// A vehicle that hovers wanders within this distance, and flies nowhere.
constexpr double kHoverRadius_m = 0.3;

bool same(const common::Pose2& a, const common::Pose2& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && a.yaw_rad == b.yaw_rad;
}

bool same(const std::vector<common::PlaceCandidate>& a, const std::vector<common::PlaceCandidate>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one.weight == other.weight && same(one.T_given_body, other.T_given_body);
  });
}

bool same(const std::optional<common::Localization>& a, const std::optional<common::Localization>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->state == b->state && a->stamp == b->stamp && same(a->T_given_odom, b->T_given_odom) &&
         same(a->T_given_body, b->T_given_body) && a->covariance == b->covariance && a->explained == b->explained &&
         a->places == b->places && same(a->candidates, b->candidates);
}

/// The pointed-to values are immutable, so comparing pointers is enough.
bool same(const common::MapLayer& a, const common::MapLayer& b) {
  return a.grid == b.grid && a.levels == b.levels && a.frontiers == b.frontiers &&
         a.explored_area_m2 == b.explored_area_m2 && a.keep_out == b.keep_out && a.flown == b.flown &&
         a.given == b.given && same(a.localization, b.localization);
}

template <typename Layer>
bool same(const Layer& a, const Layer& b) {
  return a == b;
}

template <typename Layer>
void replace(std::shared_ptr<const Layer>& last, Layer next) {
  if (!last || !same(*last, next)) last = std::make_shared<const Layer>(std::move(next));
}

}  // namespace

std::shared_ptr<const common::World> WorldBuilder::build(common::Time now, WorldParts parts) {
  follow(parts.vehicle);
  parts.vehicle.name = vehicle_name_;
  parts.vehicle.trail = trail_.trail();
  parts.vehicle.distance_flown_m = flown_m_ + excursion_m_;

  last_.stamp = now;
  last_.vehicle = std::make_shared<const common::VehicleLayer>(std::move(parts.vehicle));
  replace(last_.mission, std::move(parts.mission));
  replace(last_.map, std::move(parts.map));
  replace(last_.people, std::move(parts.people));
  replace(last_.energy, parts.energy);
  last_.map3d = std::move(parts.map3d);
  replace(last_.targets, std::move(parts.targets));
  if (!parts.objects || !last_.objects || !same(*last_.objects, *parts.objects)) last_.objects = parts.objects;
  return std::make_shared<const common::World>(last_);
}

void WorldBuilder::follow(const common::VehicleLayer& vehicle) {
  const Eigen::Vector2d position_odom_m = vehicle.state.T_odom_body.position_m.head<2>();
  const bool airborne = control::isAirborne(vehicle.flight_state);
  if (airborne && anchor_odom_m_) excursion_m_ = std::max(excursion_m_, (position_odom_m - *anchor_odom_m_).norm());
  if (!airborne || !anchor_odom_m_ || excursion_m_ > kHoverRadius_m) {
    flown_m_ += std::exchange(excursion_m_, 0.0);
    anchor_odom_m_ = position_odom_m;
  }
  if (airborne) {
    const Eigen::Vector2d position_map_m = vehicle.state.T_map_body().position_m.head<2>();
    const auto flown_map_m = trail_.trail().points_map_m();
    if (flown_map_m.empty() || (flown_map_m.back() - position_map_m).norm() > kShownTrailStep_m)
      trail_.add(position_map_m);
  }
}

}  // namespace swiftlet::autonomy
