#include "common/place_names.hpp"

#include <fmt/format.h>

namespace swiftlet::common {
namespace {

constexpr const char* kInGivenMap = " in the given map";

std::string coordinates(const Eigen::Vector2d& place_m) {
  return fmt::format("({:.2f}, {:.2f})", place_m.x(), place_m.y());
}

}  // namespace

Eigen::Vector2d PlaceNames::inFrame_m(const Eigen::Vector2d& place_map_m) const {
  return T_given_map ? *T_given_map * place_map_m : place_map_m;
}

std::string PlaceNames::coordinatesOf(const Eigen::Vector2d& place_map_m) const {
  return coordinates(inFrame_m(place_map_m));
}

std::string PlaceNames::of(const Eigen::Vector2d& place_map_m) const {
  return coordinatesOf(place_map_m) + (T_given_map ? kInGivenMap : "");
}

std::string PlaceNames::of(const Eigen::Vector3d& place_map_m) const {
  const Eigen::Vector2d named_m = inFrame_m(place_map_m.head<2>());
  return fmt::format("({:.2f}, {:.2f}, {:.2f}){}", named_m.x(), named_m.y(), place_map_m.z(),
                     T_given_map ? kInGivenMap : "");
}

std::string nameOfGivenPlace(const Eigen::Vector2d& place_given_m) { return coordinates(place_given_m) + kInGivenMap; }

}  // namespace swiftlet::common
