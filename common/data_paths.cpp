#include "common/data_paths.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/error.hpp"
#include "common/file_address.hpp"
#include "common/misleading.hpp"
#include "common/read_bytes.hpp"

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

bool isIn(const std::vector<fs::path>& folders, const fs::path& name) {
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
    std::error_code error;
    return fs::exists(folder / name, error);
  });
}

/// Similar folder names for the first part of a path that is not there: `missions/x.xml` for `mission/x.xml`. Nothing
/// if all of its folders are there, or none is similar.
std::optional<fs::path> withLikeFolder(const fs::path& name, const std::vector<fs::path>& folders) {
  fs::path there;
  for (auto part = name.begin(); part != name.end() && std::next(part) != name.end(); ++part) {
    if (isIn(folders, there / *part)) {
      there /= *part;
      continue;
    }
    std::set<std::string> beside;
    for (const fs::path& folder : folders) {
      std::error_code error;
      for (const auto& entry : fs::directory_iterator(folder / there, error))
        if (entry.is_directory(error)) beside.insert(entry.path().filename().string());
    }
    const auto near = nearestWord(part->string(), std::vector<std::string>(beside.begin(), beside.end()));
    if (!near) return std::nullopt;
    there /= *near;
    for (++part; part != name.end(); ++part) there /= *part;
    return there;
  }
  return std::nullopt;
}

/// A name without its ending, or without its folder: `missions/hover.xml` for `missions/hover` and for `hover.xml`.
std::optional<fs::path> completed(const fs::path& name, const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / name.parent_path(), error))
      if (entry.path().stem() == name.filename()) return name.parent_path() / entry.path().filename();
    // The current folder may be any, with thousands of others in it.
    if (name.has_parent_path() || folder == ".") continue;
    for (const auto& entry : fs::directory_iterator(folder, error))
      if (fs::is_regular_file(entry.path() / name, error)) return entry.path().filename() / name;
  }
  return std::nullopt;
}

/// The name that was meant, or all that are there if they are few.
std::string hintFor(const fs::path& name, const std::vector<fs::path>& folders) {
  if (std::string hint = misleadingHint(name.string()); !hint.empty()) return hint;
  constexpr std::size_t kFew = 30;
  const auto didMean = [](const fs::path& path) { return fmt::format("did you mean `{}`?", path.string()); };
  if (const auto whole = completed(name, folders)) return didMean(*whole);
  if (const auto other = withLikeFolder(name, folders))
    return isIn(folders, *other) ? didMean(*other) : hintFor(*other, folders);
  const std::vector<std::string> names = namesBeside(name, folders);
  std::vector<std::string> stems;
  for (const std::string& beside : names) stems.push_back(fs::path(beside).stem().string());
  // Folders and endings are the same and would make all names alike.
  if (const auto near = nearestWord(name.stem().string(), stems)) {
    const auto at = std::find(stems.begin(), stems.end(), *near) - stems.begin();
    return didMean(name.parent_path() / names[static_cast<std::size_t>(at)]);
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

namespace {

/// Searches the folders in this order.
fs::path findIn(const std::vector<fs::path>& folders, const fs::path& name) {
  std::string places;
  std::error_code unusable;  // Why a name that is there cannot be followed: a loop of links, a folder without rights.
  for (const fs::path& folder : folders) {
    std::error_code error;
    fs::path path = folder == "." ? name : folder / name;
    if (!name.empty() && fs::exists(path, error)) return path;
    if (auto problem = name.empty() ? std::nullopt : problemOfLink(path)) throw InputError(*std::move(problem));
    if (error && !unusable) unusable = error;
    places += (places.empty() ? "" : " or ") + (folder == "." ? "this folder" : folder.string());
  }
  if (unusable) throw InputError({name.string()}, "", Message("file.not-reached", "{}", unusable.message()));
  const Message message = name.is_absolute() ? Message("file.missing", "no such file")
                                             : Message("file.missing-in", "no such file in {}", places);
  throw InputError({name.string()}, "", message, name.empty() ? std::string() : hintFor(name, folders));
}

}  // namespace

fs::path findData(const fs::path& name) {
  const fs::path path = pathOfAddress(name.string());
  return findIn(path.is_absolute() ? std::vector<fs::path>{"/"} : dataFolders(), path);
}

fs::path findBeside(const fs::path& folder, const fs::path& name) {
  const fs::path path = pathOfAddress(name.string()), beside = folder / path;
  std::error_code failure;
  if (fs::exists(beside, failure) || failure) return beside;
  if (path.is_absolute()) return findData(path);
  std::vector<fs::path> folders = dataFolders();
  const auto isFolder = [&](const fs::path& other) { return fs::equivalent(folder, other, failure); };
  if (!folder.empty() && std::none_of(folders.begin(), folders.end(), isFolder))
    folders.insert(folders.begin(), folder);
  return findIn(folders, path);
}

}  // namespace swiftlet::common
