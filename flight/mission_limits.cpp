#include "flight/mission_limits.hpp"

#include <algorithm>

#include "autonomy/flight_sensors.hpp"
#include "behaviors/mission_check.hpp"
#include "common/error.hpp"
#include "flight/files_of_kind.hpp"
#include "flight/given_map.hpp"

namespace swiftlet::flight {

double unseenBelow_m(const System& system) {
  return system.hasDepthCamera() ? 0.0 : std::max(0.5 * system.vehicle.hull_height_m + system.laser.mount.z_m, 0.0);
}

behaviors::MissionLimits missionLimits(const System& system, bool has_map) {
  behaviors::MissionLimits limits;
  limits.unseen_below_m = unseenBelow_m(system);
  limits.max_height_m = system.vehicle.max_height_m;
  limits.measured_height_m = autonomy::measuredHeight_m(system.laser);
  limits.least_measured_height_m = autonomy::leastMeasuredHeight_m(system.laser);
  limits.clearance_problems = [autonomy = system.config.autonomy](double clearance_m) {
    return autonomy.problemsWith(clearance_m);
  };
  limits.has_map = has_map;
  limits.map_problem = [](const std::string& map, const std::string& mission) -> std::optional<common::Problem> {
    try {
      (void)readUsableMap(missionMap(map, mission));
      return std::nullopt;
    } catch (const common::InputError& wrong) {
      return wrong.problems().front();
    }
  };
  limits.has_camera = system.hasDepthCamera();
  limits.target_names = system.config.autonomy.estimator.targets.names();
  return limits;
}

std::vector<common::Problem> missionProblems(const std::string& mission, const System& system, bool has_map,
                                             const tree::Registry& types) {
  try {
    return behaviors::checkMission(findMission(mission), missionLimits(system, has_map), types);
  } catch (const common::InputError& missing) {
    return missing.problems();
  }
}

}  // namespace swiftlet::flight
