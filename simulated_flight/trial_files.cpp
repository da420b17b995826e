#include "simulated_flight/trial_files.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/data_paths.hpp"
#include "common/file_address.hpp"
#include "flight/files_of_kind.hpp"
#include "flight/system.hpp"

namespace swiftlet::simulated_flight {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Problem;
using evaluation::TrialConfig;

bool isFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::optional<Problem> findFile(const TrialConfig& trial, const std::string& key, std::string& name,
                                const char* ending) {
  name = common::pathOfAddress(name);
  const std::vector<fs::path> folders = common::dataFolders();
  for (const std::string& file : {name, name + ending}) {
    const auto hasIt = [&file](const fs::path& folder) { return isFile(folder / file); };
    if (name.empty() || std::any_of(folders.begin(), folders.end(), hasIt)) return std::nullopt;
    if (!hasIt(trial.folder)) continue;
    name = (trial.folder / file).string();
    return std::nullopt;
  }
  try {
    (void)common::findBeside(trial.folder, name);
    return std::nullopt;  // No regular file: its reader reports why.
  } catch (const InputError& missing) {
    return inTrial(trial, key, name, missing.problems().front());
  }
}

}  // namespace

Problem inTrial(const TrialConfig& trial, const std::string& key, const std::string& name, Problem problem) {
  const common::SourceLocation place = trial.placeOf(key);
  if (place.file.empty()) return problem;
  if (const fs::path file = fs::path(name).filename(); file != name && isFile(trial.folder / file))
    problem.hint = fmt::format("did you mean `{}`?", file.string());
  return {place, key, problem.message.behind(name + ": "), std::move(problem.hint)};
}

std::optional<Problem> findMissionOf(const TrialConfig& trial, const std::string& key, std::string& name) {
  std::optional<Problem> problem = findFile(trial, key, name, ".xml");
  if (problem && !problem->hint.empty()) return problem;
  try {
    (void)flight::findMission(name);
  } catch (const InputError& error) {
    if (!problem) return inTrial(trial, key, name, error.problems().front());
    problem->hint = error.problems().front().hint;  // It may be like one of the folder `missions`.
  }
  return problem;
}

std::optional<Problem> findSystemOf(TrialConfig& trial) {
  const std::string key = trial.placeOf("system").file.empty() ? "systems" : "system";
  if (trial.system.find_first_of("/.") != std::string::npos) return findFile(trial, key, trial.system, ".yaml");
  const fs::path file = trial.system + ".yaml", path = "config/systems" / file;
  try {
    (void)common::findData(path);
    return std::nullopt;
  } catch (const InputError& missing) {
    Problem problem = inTrial(trial, key, path.string(), missing.problems().front());
    if (const std::string similar = common::didYouMean(trial.system, flight::systemNames()); !similar.empty())
      problem.hint = similar;
    return problem;
  }
}

}  // namespace swiftlet::simulated_flight
