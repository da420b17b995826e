#include "apps/given_map.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "apps/files_of_kind.hpp"
#include "apps/required.hpp"
#include "apps/show.hpp"
#include "apps/system.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "evaluation/trajectory_metrics.hpp"
#include "perception/slam2d/laser_slam.hpp"
#include "simulation/ray_caster.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

/// The coarsest map to localize and fly in. A door of 0.8 m, which the hull of 0.6 m just passes, is four cells of it;
/// on a coarser one it closes wherever a frame falls on the edge of a cell.
constexpr double kCoarsest_m = 0.2;

/// T_world_given: the rigid fit of the SLAM poses to the driven ones. nullopt if they do not determine a direction.
std::optional<common::Pose2> fitted(const perception::LaserSlam& slam,
                                    const std::vector<perception::TrackedScan>& tracked,
                                    const std::vector<common::Pose2>& driven) {
  const std::vector<common::Pose2> keys = slam.keyPoses();
  std::vector<evaluation::PosePair> pairs;
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    const common::Pose2 estimate = tracked[i].T_map_robot(keys);
    pairs.push_back({{}, common::lifted(estimate, 0.0), common::lifted(driven[i], 0.0)});
  }
  const auto T_world_given = evaluation::align(pairs, evaluation::Alignment::kPlanar);
  if (!T_world_given) return std::nullopt;
  return common::planar(*T_world_given);
}

/// What makes a map that cannot be used of a picture that probably can.
std::string whyEmpty(const std::vector<common::Problem>& notes) {
  const auto of_mode =
      std::find_if(notes.begin(), notes.end(), [](const auto& note) { return note.element == "mode"; });
  if (of_mode == notes.end()) return "are `negate` and the thresholds those of the picture?";
  return of_mode->message + (of_mode->hint.empty() ? "" : ": " + of_mode->hint);
}

}  // namespace

interfaces::StoredMap readUsableMap(const fs::path& yaml_file) {
  refuseOtherKind(yaml_file.string(), "a map");
  interfaces::StoredMap stored = interfaces::readMap(yaml_file);
  if (const double resolution_m = stored.grid.resolution_m(); resolution_m > kCoarsest_m)
    throw common::InputError(
        common::Problem{stored.resolution_location, "resolution",
                        fmt::format("{} m a cell is too coarse: doors close in it", resolution_m),
                        fmt::format("give a map of at most {} m a cell; 0.05 m is usual", kCoarsest_m)});
  if (const std::string why = perception::Localizer::whyUnusable(stored.grid); !why.empty())
    throw common::InputError(common::Problem{stored.image_location, "image", why, whyEmpty(stored.notes)});
  return stored;
}

fs::path missionMap(const std::string& map, const std::string& mission_file) {
  return common::findBeside(fs::path(mission_file).parent_path(), map);
}

std::vector<common::Problem> mapNotes(const std::vector<std::string>& maps, const std::string& mission_file) {
  std::vector<common::Problem> notes;
  for (const std::string& map : maps) {
    const auto of_map = readUsableMap(missionMap(map, mission_file)).notes;
    notes.insert(notes.end(), of_map.begin(), of_map.end());
  }
  return notes;
}

void showNotes(const std::vector<common::Problem>& notes) {
  for (const common::Problem& note : notes) showError("note: " + toString(note) + "\n");
}

std::vector<autonomy::OfferedMap> offeredMaps(const std::vector<std::string>& maps, const std::string& mission_file,
                                              std::uint64_t seed) {
  std::vector<autonomy::OfferedMap> offered;
  for (const std::string& map : maps) {
    offered.push_back({map, readFlightMap(missionMap(map, mission_file)).map});
    offered.back().map.name = map;
    offered.back().map.seed = seed;
  }
  return offered;
}

FlightMap readFlightMap(const fs::path& yaml_file) {
  interfaces::StoredMap stored = readUsableMap(yaml_file);
  FlightMap map;
  map.map.name = yaml_file.string();
  map.map.grid = std::make_shared<const common::OccupancyGrid>(std::move(stored.grid));
  map.map.T_given_grid = stored.T_map_grid;
  map.notes = std::move(stored.notes);
  return map;
}

FlightMap surveyedMap(const simulation::SurveyConfig& survey, const simulation::WorldModel& world,
                      const fs::path& folder) {
  const simulation::RayCaster rays(world);
  simulation::SurveyDrive drive(survey, loadLaser(survey.laser), rays);
  perception::LaserSlam slam{laserSlamOf(loadSystem("laser_log"))};
  std::vector<perception::TrackedScan> tracked;
  std::vector<common::Pose2> driven;
  while (const auto taken = drive.next()) {
    const auto scan = slam.add({taken->scan, {}, std::nullopt});
    if (!scan) continue;
    tracked.push_back(*scan);
    driven.push_back(taken->T_world_body);
  }
  slam.finish();

  std::error_code failure;
  fs::create_directories(folder, failure);
  required(interfaces::writeMap(folder, "map", slam.map()));
  // The map is read back from its file, so that a flight with --map gets the same map.
  FlightMap map = readFlightMap(folder / "map.yaml");
  map.T_world_given = fitted(slam, tracked, driven);
  if (!map.T_world_given)
    throw common::InputError(common::Problem{{},
                                             "map.path_world_m",
                                             "makes a map of one spot: it cannot be laid into the world",
                                             "give it places that are some metres apart"});
  return map;
}

}  // namespace swiftlet::apps
