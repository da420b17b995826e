#include "autonomy/map_shelf.hpp"

#include <algorithm>
#include <utility>

#include "autonomy/estimator.hpp"
#include "autonomy/given_map/given_map_overlay.hpp"

namespace swiftlet::autonomy {

void MapShelf::offer(std::vector<OfferedMap> maps) {
  for (OfferedMap& map : maps) {
    std::erase_if(maps_, [&](const OfferedMap& earlier) { return earlier.file == map.file; });
    maps_.push_back(std::move(map));
  }
}

const OfferedMap* MapShelf::find(const std::string& file) const {
  const auto found = std::find_if(maps_.begin(), maps_.end(), [&](const OfferedMap& map) { return map.file == file; });
  return found == maps_.end() ? nullptr : &*found;
}

std::string MapShelf::problemOf(const std::string& file) const {
  return find(file) != nullptr ? std::string() : "the map `" + file + "` was not read before the mission";
}

std::optional<common::MissionAnswer> MapShelf::take(const common::MissionRequest& request, Estimator& estimator,
                                                    GivenMapOverlay& overlay) const {
  if (const auto* load = std::get_if<common::LoadMapRequest>(&request.kind)) {
    const OfferedMap* offered = find(load->file);
    if (offered == nullptr) return common::MissionAnswer{request.id, false, problemOf(load->file)};
    estimator.loadMap(offered->map);
    overlay.load(offered->map);
    return common::MissionAnswer{request.id, true, "map " + load->file + " is the given one"};
  }
  if (std::holds_alternative<common::RelocalizeRequest>(request.kind)) {
    if (!estimator.forgetPlace()) return common::MissionAnswer{request.id, false, "the flight was given no map"};
    return common::MissionAnswer{request.id, true, "the place in the given map is looked for anew"};
  }
  return std::nullopt;
}

}  // namespace swiftlet::autonomy
