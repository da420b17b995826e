#include "flight/given_map.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "flight/files_of_kind.hpp"

namespace swiftlet::flight {
namespace {

namespace fs = std::filesystem;

/// The coarsest map to localize and fly in. A door of 0.8 m, which the hull of 0.6 m just passes, is four cells of it;
/// on a coarser one it closes wherever a frame falls on the edge of a cell.
constexpr double kCoarsest_m = 0.2;

/// What makes a map that cannot be used of a picture that probably can.
std::string whyEmpty(const std::vector<common::Problem>& notes) {
  const auto of_mode =
      std::find_if(notes.begin(), notes.end(), [](const auto& note) { return note.element == "mode"; });
  if (of_mode == notes.end()) return "are `negate` and the thresholds those of the picture?";
  return of_mode->message.text() + (of_mode->hint.empty() ? "" : ": " + of_mode->hint);
}

}  // namespace

interfaces::StoredMap readUsableMap(const fs::path& yaml_file) {
  refuseOtherKind(yaml_file.string(), "a map");
  interfaces::StoredMap stored = interfaces::readMap(yaml_file);
  if (const double resolution_m = stored.grid.resolution_m(); resolution_m > kCoarsest_m)
    throw common::InputError(
        stored.resolution_location, "resolution",
        common::Message("map.too-coarse", "{} m a cell is too coarse: doors close in it", resolution_m),
        fmt::format("give a map of at most {} m a cell; 0.05 m is usual", kCoarsest_m));
  if (const auto why = perception::Localizer::whyUnusable(stored.grid))
    throw common::InputError(stored.image_location, "image", *why, whyEmpty(stored.notes));
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

}  // namespace swiftlet::flight
