#include "common/data_paths.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/error.hpp"

namespace swiftlet::common {
namespace {

namespace fs = std::filesystem;

/// The names in the folder of a missing file that end as its own does, or all of them if none does.
std::vector<std::string> namesBeside(const fs::path& name, const std::vector<fs::path>& folders) {
  std::set<std::string> alike, all;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / name.parent_path(), error)) {
      const fs::path beside = entry.path().filename();
      if (beside == name.filename()) continue;
      all.insert(beside.string());
      if (beside.extension() == name.extension()) alike.insert(beside.string());
    }
  }
  const std::set<std::string>& names = alike.empty() ? all : alike;
  return {names.begin(), names.end()};
}

/// The name that was meant, or all that are there if they are few.
std::string hintFor(const fs::path& name, const std::vector<fs::path>& folders) {
  constexpr std::size_t kFew = 30;
  const std::vector<std::string> names = namesBeside(name, folders);
  std::vector<std::string> stems;
  for (const std::string& beside : names) stems.push_back(fs::path(beside).stem().string());
  // Folders and endings are the same and would make all names alike.
  if (const auto near = nearestWord(name.stem().string(), stems)) {
    const auto at = std::find(stems.begin(), stems.end(), *near) - stems.begin();
    return fmt::format("did you mean `{}`?", (name.parent_path() / names[static_cast<std::size_t>(at)]).string());
  }
  if (names.empty() || names.size() > kFew || !name.has_parent_path()) return {};
  return fmt::format("{} has {}", name.parent_path().string(), fmt::join(names, ", "));
}

}  // namespace

std::vector<fs::path> dataFolders() {
  std::vector<fs::path> candidates = {"."};
  if (const char* given = std::getenv("SWIFTLET_DATA"); given != nullptr && *given != '\0')
    candidates.emplace_back(given);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) candidates.push_back(program.parent_path().parent_path() / "share/swiftlet");
  candidates.emplace_back(SWIFTLET_SOURCE_DIR);

  std::vector<fs::path> folders;
  for (const fs::path& candidate : candidates)
    if (fs::is_directory(candidate, error)) folders.push_back(candidate);
  return folders;
}

fs::path findData(const fs::path& name) {
  const std::vector<fs::path> folders = name.is_absolute() ? std::vector<fs::path>{"/"} : dataFolders();
  std::string places;
  std::error_code unusable;  // Why a name that is there cannot be followed: a loop of links, a folder without rights.
  for (const fs::path& folder : folders) {
    std::error_code error;
    fs::path path = folder == "." ? name : folder / name;
    if (!name.empty() && fs::exists(path, error)) return path;
    if (error && !unusable) unusable = error;
    places += (places.empty() ? "" : " or ") + (folder == "." ? "this folder" : folder.string());
  }
  if (unusable) throw InputError(Problem{{name.string()}, "", unusable.message(), ""});
  const std::string message = name.is_absolute() ? "no such file" : "no such file in " + places;
  throw InputError(Problem{{name.string()}, "", message, hintFor(name, folders)});
}

fs::path findBeside(const fs::path& folder, const fs::path& name) {
  const fs::path beside = folder / name;
  std::error_code failure;
  return fs::exists(beside, failure) || failure ? beside : findData(name);
}

}  // namespace swiftlet::common
