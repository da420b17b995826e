#include "flight/mission_shelf.hpp"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "behaviors/mission.hpp"
#include "behaviors/tree/parameters.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/operator_text.hpp"
#include "common/read_bytes.hpp"
#include "flight/given_map.hpp"

namespace swiftlet::flight {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostMissionBytes = std::size_t{1} << 20;

/// The first comment of a mission says what it does.
std::string firstComment(const std::string& text) {
  const std::size_t begin = text.find("<!--"), end = text.find("-->");
  if (begin == std::string::npos || end == std::string::npos || end < begin + 4 || begin > text.find("<root"))
    return {};
  const std::string comment = text.substr(begin + 4, end - begin - 4);
  const std::size_t first = comment.find_first_not_of(" \n\r\t"), last = comment.find_last_not_of(" \n\r\t");
  return first == std::string::npos ? std::string() : comment.substr(first, last - first + 1);
}

/// The maps that a mission may load, read now: in flight no file is read. A text that is no mission has no maps;
/// the check of missions reports why. Throws common::InputError for a map that cannot be used.
std::vector<common::OfferedMap> mapsOf(const std::string& text, const std::string& file, std::uint64_t seed,
                                       const behaviors::NodeTypes& types) {
  std::optional<behaviors::Mission> mission;
  try {
    mission = behaviors::Mission::fromText(text, file, types);
  } catch (const common::InputError&) {
    return {};
  }
  return offeredMaps(mission->mapFiles(), file, seed);
}

nlohmann::json parametersJson(const std::string& text, const std::string& file, const tree::Registry& types) {
  auto list = nlohmann::json::array();
  for (const tree::Parameter& parameter : tree::parametersOf(text, file, types))
    list.push_back({{"key", parameter.key},
                    {"node", parameter.node},
                    {"port", parameter.port->name},
                    {"value", parameter.value},
                    {"expected", tree::expectedOf(*parameter.port)},
                    {"about", parameter.port->description},
                    {"choices", parameter.port->choices}});
  return list;
}

}  // namespace

/// Found by a file that is always among them.
fs::path shippedMissions() {
  try {
    return common::findData("missions/explore_and_return.xml").parent_path();
  } catch (const common::InputError&) {
    return "missions";
  }
}

std::vector<fs::path> FolderShelf::files() const {
  std::vector<fs::path> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error))
    if (entry.path().extension() == ".xml" && !fs::equivalent(entry.path(), first_, error))
      found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  found.insert(found.begin(), first_);
  return found;
}

std::string FolderShelf::list() {
  auto missions = nlohmann::json::array();
  for (const fs::path& file : files()) {
    try {
      const std::string text = common::readBytes(file, kMostMissionBytes);
      missions.push_back({{"file", file.string()},
                          {"name", file.stem().string()},
                          {"about", firstComment(text)},
                          {"parameters", parametersJson(text, file.string(), *types_)}});
    } catch (const common::InputError&) {
      // A file that has just gone, or that may not be read, is not offered.
    }
  }
  return missions.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

tl::expected<common::StartMissionCommand, std::string> FolderShelf::take(
    const std::string& file, const std::map<std::string, std::string>& parameters) {
  const std::vector<fs::path> offered = files();
  if (std::find(offered.begin(), offered.end(), fs::path(file)) == offered.end())
    return tl::unexpected("there is no mission `" + fs::path(file).filename().string() + "` any more: choose another");
  try {
    tree::Changed changed = tree::withParameters(common::readBytes(file, kMostMissionBytes), file, *types_, parameters);
    if (!changed.problems.empty()) return tl::unexpected(common::withoutFolders(toString(changed.problems.front())));
    std::vector<common::OfferedMap> maps = mapsOf(changed.text, file, map_seed_, types_);
    return common::StartMissionCommand{file, std::move(changed.text), std::move(maps)};
  } catch (const common::InputError& error) {
    return tl::unexpected(common::forOperator(error));
  }
}

}  // namespace swiftlet::flight
