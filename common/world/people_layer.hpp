// The World's layer of people: moving objects near the vehicle.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::common {

/// A person who was seen just before the snapshot, as a disc.
struct Person {
  Eigen::Vector2d position_map_m = Eigen::Vector2d::Zero();
  double radius_m = 0.0;

  bool operator==(const Person&) const = default;
};

struct PeopleLayer {
  std::vector<Person> people;
  std::optional<Eigen::Vector2d> followed_map_m;  ///< Estimated place of the followed person.

  bool operator==(const PeopleLayer&) const = default;
};

}  // namespace swiftlet::common
