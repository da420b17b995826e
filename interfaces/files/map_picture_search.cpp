#include "interfaces/files/map_picture_search.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/file_address.hpp"
#include "common/lower_case.hpp"
#include "common/read_bytes.hpp"
#include "interfaces/files/map_picture.hpp"
#include "interfaces/files/text_file.hpp"
#include "interfaces/files/unpacked_stream.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;
using common::Problem;

/// The names in the folder of a file, sorted.
std::vector<std::string> namesBeside(const fs::path& file) {
  std::vector<std::string> names;
  std::error_code failure;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
    names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string stemOf(const std::string& name) { return common::lowerCase(fs::path(name).stem().string()); }

/// The path of a file:// address, and with the home folder for `~`.
fs::path localPath(const std::string& address) {
  std::string named = common::pathOfAddress(address);
  const char* home = std::getenv("HOME");
  if (named.starts_with("~/") && home != nullptr) named.replace(0, 1, home);
  return named;
}

/// The last part of a path as any system writes it.
std::string lastPart(const std::string& path) { return path.substr(path.find_last_of("/\\") + 1); }

/// The picture beside the YAML that is most probably meant; empty without one.
std::string likelyPicture(const fs::path& yaml_file, const std::string& named) {
  const std::string wanted = common::lowerCase(lastPart(named));
  std::string best;
  int best_rank = 0;
  for (const std::string& name : namesBeside(yaml_file)) {
    const int rank = common::lowerCase(name) == wanted   ? 3
                     : stemOf(name) == stemOf(wanted)    ? 2
                     : stemOf(name) == stemOf(yaml_file) ? 1
                                                         : 0;
    if (rank <= best_rank || !isPicture(yaml_file.parent_path() / name)) continue;
    best = name;
    best_rank = rank;
  }
  return best;
}

}  // namespace

FoundPicture findPicture(const fs::path& yaml_file, const std::string& named, const common::SourceLocation& location) {
  const fs::path folder = yaml_file.parent_path(), there = folder / named, meant = folder / localPath(named);
  const std::string name = lastPart(named);
  std::error_code failure, ignored;
  if (fs::exists(there, failure)) return {there, {}};
  if (fs::exists(meant, ignored)) return {meant, {}};
  for (const char* packed : kPackedEndings)
    if (const fs::path file = there.string() + packed; !named.empty() && fs::is_regular_file(file, ignored))
      return {file, {}};
  for (const fs::path& link : {there, meant, folder / name})
    if (auto problem = common::problemOfLink(link)) throw common::InputError(*std::move(problem));
  if (!name.empty() && fs::is_regular_file(folder / name, ignored))
    return {folder / name,
            Problem{location, "image",
                    Message("map.image-beside", "`{}` is not there: `{}`, which lies beside the YAML, is taken", named,
                            name),
                    fmt::format("write `image: {}`", name)}};
  const std::string likely = likelyPicture(yaml_file, named);
  throw InputError(
      location, "image",
      Message("map.no-image", "`{}`: {}", meant.string(), failure ? failure.message() : std::string("no such file")),
      likely.empty() ? "it is looked for there, and by its name beside the YAML"
                     : fmt::format("`{0}` lies beside the YAML: write `image: {0}`", likely));
}

InputError pictureForYaml(const fs::path& picture) {
  constexpr std::size_t kMostYamlBytes = 4096;
  const std::string name = picture.filename().string();
  std::string beside;
  for (const std::string& other : namesBeside(picture)) {
    const fs::path file = picture.parent_path() / other;
    if (file.extension() != ".yaml" && file.extension() != ".yml") continue;
    if (stemOf(other) == stemOf(name)) {
      beside = file.string();
      break;
    }
    if (beside.empty() && saysAtStart(file, name, kMostYamlBytes)) beside = file.string();
  }
  return InputError({picture.string()}, "", Message("map.is-picture", "is the picture of a map, its YAML was expected"),
                    beside.empty() ? fmt::format("write `image: {}`, `resolution: 0.05` (metres a pixel) and "
                                                 "`origin: [0, 0, 0]` into a .yaml beside it, and give that",
                                                 name)
                                   : fmt::format("give `{}`", beside));
}

}  // namespace swiftlet::interfaces
