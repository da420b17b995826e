#include "apps/mission_limits.hpp"

#include "behaviors/mission_check.hpp"
#include "common/data_paths.hpp"

namespace swiftlet::apps {

behaviors::MissionLimits missionLimits(const System& system, bool has_map) {
  behaviors::MissionLimits limits;
  limits.max_height_m = system.config.autonomy.max_height_m;
  limits.clearance_problems = [autonomy = system.config.autonomy](double clearance_m) {
    return autonomy.problemsWith(clearance_m);
  };
  limits.has_map = has_map;
  return limits;
}

std::vector<common::Problem> missionProblems(const std::string& mission, const System& system, bool has_map) {
  try {
    return behaviors::checkMission(common::findData(mission).string(), missionLimits(system, has_map));
  } catch (const common::InputError& missing) {
    return missing.problems();
  }
}

behaviors::Mission soundMission(const std::string& file, const System& system, bool has_map) {
  return behaviors::Mission::fromFile(common::findData(file).string(), missionLimits(system, has_map));
}

}  // namespace swiftlet::apps
