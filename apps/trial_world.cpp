#include "apps/trial_world.hpp"

#include <cstdlib>
#include <filesystem>

#include "common/data_paths.hpp"
#include "interfaces/files/archive.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

fs::path cacheFolder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME")) return fs::path(cache) / "swiftlet";
  if (const char* home = std::getenv("HOME")) return fs::path(home) / ".cache" / "swiftlet";
  return fs::temp_directory_path() / "swiftlet";
}

bool isThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

}  // namespace

fs::path findWorldFile(const std::string& name) {
  for (const char* folder : {"", "worlds"})
    for (const char* ending : {"", ".sdf", ".world"})
      for (const fs::path& data : common::dataFolders()) {
        const fs::path path = (data == "." ? fs::path(folder) : data / folder) / (name + ending);
        if (std::error_code ignored; !name.empty() && fs::is_regular_file(path, ignored)) return path;
      }
  return common::findData(name);  // For its hint.
}

void findWorld(evaluation::TrialConfig& trial) {
  const fs::path root = common::findData("worlds").parent_path();
  fs::path unpacked = evaluation::dataSetsFolder(root);  // Models that are there as they are need no archive.
  if (!trial.archive.empty())
    unpacked = interfaces::unpackInto(cacheFolder(), evaluation::findArchive(trial.archive, unpacked));
  const std::string world = trial.scenario.world;
  const auto takeBeside = [&trial](std::string& path) {
    if (trial.archive.empty() && !path.empty() && isThere(trial.folder / path))
      path = fs::absolute(trial.folder / path);
  };
  takeBeside(trial.scenario.world);
  takeBeside(trial.map.survey.world);
  for (std::string& path : trial.scenario.model_paths) takeBeside(path);
  trial.resolvePaths(unpacked, root);
  if (!isThere(trial.scenario.world)) trial.scenario.world = world;
  trial.scenario.world = findWorldFile(trial.scenario.world).string();
  if (!trial.map.survey.world.empty()) trial.map.survey.world = findWorldFile(trial.map.survey.world).string();
}

simulation::WorldModel loadWorldOf(const simulation::Scenario& scenario, const std::string& file) {
  using simulation::IncompleteWorld;
  return simulation::loadWorld(file.empty() ? scenario.world : file, scenario.model_paths,
                               scenario.allow_incomplete_world ? IncompleteWorld::kAllowed : IncompleteWorld::kRefused);
}

}  // namespace swiftlet::apps
