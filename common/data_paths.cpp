#include "common/data_paths.hpp"

#include <cstdlib>
#include <string>
#include <system_error>

#include "common/error.hpp"

namespace swiftlet::common {
namespace {

namespace fs = std::filesystem;

/// The files beside the missing file, to suggest a name when it was misspelled.
std::vector<std::string> siblingsOf(const fs::path& name, const std::vector<fs::path>& folders) {
  std::vector<std::string> siblings;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / name.parent_path(), error))
      if (entry.path().filename() != name.filename())
        siblings.push_back((name.parent_path() / entry.path().filename()).string());
  }
  return siblings;
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
    places += (places.empty() ? "" : ", ") + folder.string();
  }
  if (unusable) throw InputError(Problem{{name.string()}, "", unusable.message(), ""});
  const std::string message = name.is_absolute() ? "no such file" : "no such file in " + places;
  throw InputError(Problem{{name.string()}, "", message, didYouMean(name.string(), siblingsOf(name, folders))});
}

fs::path findBeside(const fs::path& folder, const fs::path& name) {
  const fs::path beside = folder / name;
  std::error_code failure;
  return fs::exists(beside, failure) || failure ? beside : findData(name);
}

}  // namespace swiftlet::common
