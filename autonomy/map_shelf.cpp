#include "autonomy/map_shelf.hpp"

#include <algorithm>
#include <memory>
#include <utility>

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

std::optional<common::Message> MapShelf::problemOf(const std::string& file) const {
  if (find(file) != nullptr) return std::nullopt;
  return common::Message("map.not-offered", "the map `{}` was not read before the mission", file);
}

std::optional<MapShelf::Answer> MapShelf::take(const common::MissionRequest& request, bool given) const {
  if (const auto* load = std::get_if<common::LoadMapRequest>(&request.kind)) {
    const OfferedMap* offered = find(load->file);
    if (offered == nullptr) return Answer{{request.id, false, problemOf(load->file)->text()}, std::nullopt};
    return Answer{{request.id, true, "map " + load->file + " is the given one"},
                  GivenMapOrder{std::make_shared<const common::GivenMap>(offered->map)}};
  }
  if (std::holds_alternative<common::RelocalizeRequest>(request.kind)) {
    if (!given) return Answer{{request.id, false, "the flight was given no map"}, std::nullopt};
    return Answer{{request.id, true, "localization in the given map starts again"}, GivenMapOrder{}};
  }
  return std::nullopt;
}

}  // namespace swiftlet::autonomy
