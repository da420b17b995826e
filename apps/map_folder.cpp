#include "apps/map_folder.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 6> kFiles = {"map.pgm",        "map.yaml",  "map.png",
                                               "trajectory.tum", "graph.g2o", "report.html"};
constexpr const char* kAskForAnother = "give an empty or new folder by --out";

bool isMapFile(const std::string& name) {
  // A `.part` is what a killed process left of a file of ours.
  return std::any_of(kFiles.begin(), kFiles.end(), [&](const std::string& file) {
    return name == file || (name.starts_with(file + ".") && name.ends_with(".part"));
  });
}

common::InputError unusable(const fs::path& path, const std::string& message, const std::string& hint) {
  return common::InputError(common::Problem{{path.string()}, "", message, hint});
}

}  // namespace

MapFolder::MapFolder(fs::path path) : path_(std::move(path)) {
  try {
    if (fs::exists(path_) && !fs::is_directory(path_)) throw unusable(path_, "is not a folder", kAskForAnother);
    made_ = fs::create_directories(path_);
    lock_.emplace(path_);
    if (lock_->refused()) throw unusable(path_, "is being written by another run", kAskForAnother);
    if (!made_) refuseWhatIsNoMap();
  } catch (const fs::filesystem_error& e) {
    throw unusable(path_, fmt::format("cannot be used: {}", e.code().message()), "");
  }
}

void MapFolder::refuseWhatIsNoMap() const {
  bool empty = true;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_regular_file() || !isMapFile(name))
      throw unusable(path_, fmt::format("holds `{}`, which is no file of a map", name), kAskForAnother);
    empty = false;
  }
  // A flight, or somebody else's map, has files of the same names.
  if (!empty && !interfaces::saysAtStart(path_ / "report.html", "<title>Map of ", 400))
    throw unusable(path_, "holds no map of this program, and what it holds would be lost", kAskForAnother);
}

MapFolder::~MapFolder() {
  std::error_code ignored;
  if (made_ && fs::is_empty(path_, ignored)) fs::remove(path_, ignored);
}

}  // namespace swiftlet::apps
