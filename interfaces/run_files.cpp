#include "interfaces/run_files.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "interfaces/files/text_file.hpp"
#include "interfaces/files/unusable_folder.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;

/// Every file that a run may leave; no other file is ever removed.
constexpr std::array<const char*, 26> kFiles = {"mission.json",
                                                "events.jsonl",
                                                "objects.json",
                                                "topological_map.yaml",
                                                "trajectory.tum",
                                                "trajectory_given.tum",
                                                "trajectory_camera.tum",
                                                "map.pgm",
                                                "map.yaml",
                                                "map.png",
                                                "map.bt",
                                                "map.ot",
                                                "cloud.ply",
                                                "report.html",
                                                "config.yaml",
                                                "nature.yaml",
                                                "vehicle.yaml",
                                                "laser.yaml",
                                                "rgbd_camera.yaml",
                                                "vertical_laser.yaml",
                                                "vehicle_model.yaml",
                                                kMemoryReadFile,
                                                kMemoryLearnedFile,
                                                "ground_truth.tum",
                                                "control.tsv",
                                                "fusion.tsv"};

bool isRunFile(const std::string& name) {
  const auto isNamed = [&](const char* begin, const char* end) {
    return name.starts_with(begin) && name.ends_with(end);
  };
  if (isNamed("map-", ".pgm") || isNamed("map-", ".yaml") || isNamed("photo-", ".jpg") || isNamed("object-", ".jpg") ||
      isNamed("pattern-", ".png") || isNamed("pattern-", ".jpg") || isNamed("house-", ".yaml") ||
      isNamed("photo-", ".json"))
    return true;
  // A `.part` file is left of a Swiftlet file if the process was killed.
  return std::any_of(kFiles.begin(), kFiles.end(), [&](const std::string& file) {
    return name == file || (name.starts_with(file + ".") && name.ends_with(".part"));
  });
}

/// Whether mission.json belongs to a run. A profile or a map of another program may have the same name as a file of a
/// run.
bool holdsRun(const fs::path& folder) { return saysAtStart(folder / "mission.json", "swiftlet mission", 200); }

constexpr const char* kAskForAnother = "give an empty or new folder";

InputError unusable(const fs::path& path, Message message, const char* hint = kAskForAnother) {
  return InputError({path.string()}, "", std::move(message), hint);
}

/// What `use` does with the folder's files; why they cannot be used is an InputError.
template <typename Use>
void usingFolder(const fs::path& path, Use use) {
  try {
    use();
  } catch (const fs::filesystem_error& e) {
    throw InputError(unusableFolder(path, e.code()));
  }
}

void requireFolder(const fs::path& path) {
  if (fs::exists(path) && !fs::is_directory(path))
    throw unusable(path, Message("folder.none", "is not a folder"), "give a folder for the run");
}

FolderLock lockOf(const fs::path& path) {
  FolderLock lock(path);
  if (lock.refused()) throw unusable(path, Message("run.in-use", "is being written by another flight"));
  return lock;
}

/// The files of an older run. Throws if the folder holds anything else.
std::vector<fs::path> filesOfOlderRun(const fs::path& path) {
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    if (!entry.is_regular_file() || !isRunFile(entry.path().filename().string()))
      throw unusable(
          path, Message("run.other-file", "holds `{}`, which is no file of a run", entry.path().filename().string()));
    old.push_back(entry.path());
  }
  if (!old.empty() && !holdsRun(path))
    throw unusable(path, Message("run.none", "holds no run, and what it holds would be lost"));
  return old;
}

}  // namespace

FolderLock claimedRunFolder(const fs::path& path) {
  usingFolder(path, [&] {
    requireFolder(path);
    fs::create_directories(path);
  });
  return lockOf(path);
}

const fs::path& clearedRunFolder(const fs::path& path) {
  usingFolder(path, [&] {
    for (const fs::path& file : filesOfOlderRun(path)) fs::remove(file);
  });
  return path;
}

void checkRunFolder(const fs::path& folder) {
  usingFolder(folder, [&] {
    requireFolder(folder);
    if (!fs::exists(folder)) return;
    const FolderLock lock = lockOf(folder);
    (void)filesOfOlderRun(folder);
  });
}

}  // namespace swiftlet::interfaces
