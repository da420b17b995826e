#include "simulated_flight/trial_world.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "common/misleading.hpp"
#include "flight/files_of_kind.hpp"
#include "interfaces/files/archive.hpp"
#include "simulated_flight/trial_files.hpp"

namespace swiftlet::simulated_flight {
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

/// The world of the shipped folders, or of `beside`, whose name is most like this one, in any case; empty if no name
/// is.
std::string similarWorld(const std::string& name, const fs::path& beside) {
  std::vector<std::string> files, stems;
  const auto addFolder = [&](const fs::path& folder, const fs::path& shown) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
      const fs::path file = entry.path().filename();
      if (file.extension() != ".sdf" && file.extension() != ".world") continue;
      files.push_back((shown / file).string());
      stems.push_back(common::lowerCase(file.stem().string()));
    }
  };
  if (!beside.empty()) addFolder(beside, {});
  for (const char* folder : {"worlds", "trials/worlds"})
    for (const fs::path& data : common::dataFolders()) addFolder(data / folder, folder);
  const auto near = common::nearestWord(common::lowerCase(fs::path(name).stem().string()), stems);
  if (!near) return {};
  return files[static_cast<std::size_t>(std::find(stems.begin(), stems.end(), *near) - stems.begin())];
}

bool isInAny(const std::vector<fs::path>& bases, const fs::path& name) {
  return std::any_of(bases.begin(), bases.end(), [&](const fs::path& base) { return isThere(base / name); });
}

/// The folder beside the first part of the path that is not there whose name is most like that; empty if none is.
std::string hintForFolder(fs::path name, const std::vector<fs::path>& bases) {
  if (std::string hint = common::misleadingHint(name.string()); !hint.empty()) return hint;
  while (!name.empty() && (!name.has_filename() || (name.has_parent_path() && !isInAny(bases, name.parent_path()))))
    name = name.parent_path();
  std::vector<std::string> there;
  for (const fs::path& base : bases) {
    std::error_code error;
    const fs::path around = (base / name).parent_path();
    for (const auto& entry : fs::directory_iterator(around.empty() ? "." : around, error))
      if (entry.is_directory(error)) there.push_back(entry.path().filename().string());
  }
  const auto near = common::nearestWord(name.filename().string(), there);
  return near ? "did you mean `" + (name.parent_path() / *near).string() + "`?" : "";
}

void findModels(evaluation::TrialConfig& trial, const fs::path& unpacked, const fs::path& root) {
  std::vector<fs::path> bases = {unpacked, root, ""};
  if (trial.archive.empty()) bases.insert(bases.begin(), trial.folder);
  for (std::string& path : trial.scenario.model_paths)
    path = fs::absolute(findModelFolder(path, "trial " + trial.name + ": scenario.model_paths", bases)).string();
}

}  // namespace

fs::path findModelFolder(const std::string& name, const std::string& key, const std::vector<fs::path>& bases) {
  std::error_code ignored;
  std::string searched;
  for (const fs::path& base : bases) {
    if (!name.empty() && fs::is_directory(base / name, ignored)) return base / name;
    const std::string place = base.empty() ? "this folder" : base.string();
    if (searched.find(place) == std::string::npos) searched += (searched.empty() ? " in " : " or ") + place;
  }
  if (name.empty() || fs::path(name).is_absolute()) searched.clear();
  if (!name.empty() && isInAny(bases, name))
    throw common::InputError({name}, key, common::Message("folder.none", "is not a folder"));
  throw common::InputError({}, key, common::Message("folder.missing", "there is no folder `{}`{}", name, searched),
                           hintForFolder(name, bases));
}

fs::path findWorldFile(const std::string& name, const fs::path& beside) {
  for (const char* folder : {"", "worlds"})
    for (const char* ending : {"", ".sdf", ".world"})
      for (const fs::path& data : common::dataFolders()) {
        const fs::path path = (data == "." ? fs::path(folder) : data / folder) / (name + ending);
        if (std::error_code ignored; !name.empty() && fs::is_regular_file(path, ignored)) {
          flight::refuseOtherKind(path.string(), "a world");
          return path;
        }
      }
  try {
    return common::findBeside(beside, name);  // For its message.
  } catch (const common::InputError& error) {
    common::Problem problem = error.problems().front();
    // Of a bare name the hint would be any file of the working folder.
    if (const std::string similar = similarWorld(name, beside); !name.empty() && !fs::path(name).has_parent_path())
      problem.hint = similar.empty() ? "" : "did you mean `" + similar + "`?";
    throw common::InputError(problem);
  }
}

namespace {

/// At the place of the trial that names it.
std::string worldOf(const evaluation::TrialConfig& trial, const std::string& key, const std::string& name) {
  try {
    return findWorldFile(name, trial.folder).string();
  } catch (const common::InputError& missing) {
    throw common::InputError(inTrial(trial, key, name, missing.problems().front()));
  }
}

}  // namespace

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
  for (std::string* named : {&trial.scenario.world, &trial.map.survey.world})
    for (const char* ending : {"", ".sdf", ".world"}) {
      std::string file = named->empty() ? "" : *named + ending;
      if (std::error_code ignored; file.empty() || !fs::is_regular_file(trial.folder / file, ignored)) continue;
      takeBeside(file);
      *named = file;
      break;
    }
  findModels(trial, unpacked, root);
  trial.resolvePaths(unpacked, root);
  if (!isThere(trial.scenario.world)) trial.scenario.world = world;
  trial.scenario.world = worldOf(trial, "scenario.world", trial.scenario.world);
  if (!trial.map.survey.world.empty())
    trial.map.survey.world = worldOf(trial, "map.survey.world", trial.map.survey.world);
}

simulation::WorldModel loadWorldOf(const simulation::Scenario& scenario, const std::string& file) {
  using simulation::IncompleteWorld;
  return simulation::loadWorld(file.empty() ? scenario.world : file, scenario.model_paths,
                               scenario.allow_incomplete_world ? IncompleteWorld::kAllowed : IncompleteWorld::kRefused);
}

}  // namespace swiftlet::simulated_flight
