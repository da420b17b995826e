// The World's layer of people: moving objects near the vehicle.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/disc.hpp"

namespace swiftlet::common {

struct PeopleLayer {
  std::vector<Disc> people;                       ///< Those who were seen just before the snapshot.
  std::optional<Eigen::Vector2d> followed_map_m;  ///< Estimated place of the followed person.

  bool operator==(const PeopleLayer&) const = default;
};

}  // namespace swiftlet::common
