// A field and a scan of a building of the tests.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/random.hpp"
#include "perception/localization/map_field.hpp"
#include "tests/localization/buildings.hpp"

namespace swiftlet::test {

inline std::shared_ptr<const perception::MapField> fieldOf(const Building& building) {
  return std::make_shared<const perception::MapField>(mapOf(building));
}

inline std::vector<Eigen::Vector2f> pointsAt(const Building& building, const common::Pose2& pose,
                                             std::uint64_t seed = 1) {
  common::RandomStream random(seed, "points");
  return levelScan(building.world, pose, common::Time{}, random).points_level_m;
}

}  // namespace swiftlet::test
