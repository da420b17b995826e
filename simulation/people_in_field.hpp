// Since when people are in the field of the laser: between its outermost beams, within its range, and with nothing of
// the world before them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "common/vehicle_config.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/walkers.hpp"

namespace swiftlet::simulation {

class PeopleInField {
 public:
  /// The rays must outlive it.
  PeopleInField(const common::LaserConfig& laser, const RayCaster& rays);

  /// Call in the order of time, with the same walkers each time.
  void look(common::Time now, const common::Pose3& T_world_body, std::span<const Walker> walkers);

  /// When the walker was first in the field since it came into the world; nullopt: it has not been yet.
  const std::optional<common::Time>& since(std::size_t walker) const { return since_.at(walker); }

 private:
  bool sees(const common::Pose3& T_world_laser, const Actor& person) const;

  common::LaserConfig laser_;
  const RayCaster& rays_;
  std::vector<std::optional<common::Time>> since_;
};

}  // namespace swiftlet::simulation
