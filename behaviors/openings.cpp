#include "behaviors/openings.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"

namespace swiftlet::behaviors {

using common::RecognizedObject;

ObjectPointers objectsNear(const common::World& world, std::string_view what, const Eigen::Vector2d& place_map_m,
                           double within_m) {
  ObjectPointers near;
  if (world.objects == nullptr) return near;
  const auto away_m = [&](const RecognizedObject& one) {
    return (one.T_map_object.position_m.head<2>() - place_map_m).norm();
  };
  for (const RecognizedObject& one : world.objects->objects)
    if (one.what == what && away_m(one) <= within_m) near.push_back(&one);
  std::stable_sort(near.begin(), near.end(), [&](const auto* a, const auto* b) { return away_m(*a) < away_m(*b); });
  return near;
}

const RecognizedObject* objectWithId(const common::World& world, int id) {
  return world.objects == nullptr ? nullptr : world.objects->withId(id);
}

bool isOpenFor(const RecognizedObject& opening, double width_m) {
  return opening.confirmed && opening.passage == common::Passage::kOpen && opening.size_m.x() >= width_m;
}

Eigen::Vector2d directionThrough(const RecognizedObject& opening, const Eigen::Vector2d& from_map_m) {
  const double normal_rad = common::yawOf(opening.T_map_object.rotation);
  const Eigen::Vector2d normal(std::cos(normal_rad), std::sin(normal_rad));
  const bool in_front = normal.dot(from_map_m - opening.T_map_object.position_m.head<2>()) > 0.0;
  return in_front ? Eigen::Vector2d(-normal) : normal;
}

}  // namespace swiftlet::behaviors
