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

}  // namespace

void findWorld(evaluation::TrialConfig& trial) {
  const fs::path root = common::findData("worlds").parent_path();
  fs::path unpacked = evaluation::dataSetsFolder(root);  // Models that are there as they are need no archive.
  if (!trial.archive.empty())
    unpacked = interfaces::unpackInto(cacheFolder(), evaluation::findArchive(trial.archive, unpacked));
  trial.resolvePaths(unpacked, root);
  trial.scenario.world = common::findData(trial.scenario.world).string();
  if (!trial.map.survey.world.empty()) trial.map.survey.world = common::findData(trial.map.survey.world).string();
}

}  // namespace swiftlet::apps
