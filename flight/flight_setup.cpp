#include "flight/flight_setup.hpp"

#include <ctime>
#include <map>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "flight/files_of_kind.hpp"
#include "flight/mission_limits.hpp"
#include "interfaces/run_folder.hpp"

namespace swiftlet::flight {

std::string startedNow() { return fmt::format("{:%Y-%m-%d_%H-%M-%S}", fmt::localtime(std::time(nullptr))); }

std::vector<FlightMission> soundMissions(const std::vector<std::string>& files, const FlightSetup& setup, bool has_map,
                                         std::uint64_t seed) {
  std::vector<FlightMission> missions;
  std::map<std::string, std::vector<common::Problem>> problems;  // By file: several may fly a wrong one.
  for (const std::string& file : files) {
    try {
      const std::string found = findMission(file);
      behaviors::MissionLimits limits = missionLimits(setup.system, has_map);
      limits.places = setup.places;
      behaviors::Mission mission = behaviors::Mission::fromFile(found, limits, setup.types);
      std::vector<autonomy::OfferedMap> maps = offeredMaps(mission.mapFiles(), found, seed);
      missions.push_back({found, std::move(mission), std::move(maps)});
    } catch (const common::InputError& wrong) {
      problems[file] = wrong.problems();
    }
  }
  std::vector<common::Problem> all = problemsOfSensors(setup.system);
  for (const auto& [file, of_file] : problems) all.insert(all.end(), of_file.begin(), of_file.end());
  if (!all.empty()) throw common::InputError(std::move(all));
  return missions;
}

void requireCamera(const System& system) {
  if (system.hasDepthCamera()) return;
  throw common::InputError({}, "--record-rgbd",
                           common::Message("record.no-camera", "the vehicle of `{}` has no RGB-D camera", system.name),
                           "`--system swiftlet_3d` has one");
}

std::filesystem::path folderOf(const FlightSetup& setup) {
  if (!setup.out.empty()) return setup.out;
  return interfaces::freshRunFolder("runs", setup.started, std::filesystem::path(setup.mission_file).stem().string());
}

}  // namespace swiftlet::flight
