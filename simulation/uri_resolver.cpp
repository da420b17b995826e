#include "simulation/uri_resolver.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/lower_case.hpp"
#include "common/misleading.hpp"

namespace swiftlet::simulation {
namespace fs = std::filesystem;
namespace {

void addFolders(const char* variable, std::vector<fs::path>& folders) {
  const char* list = std::getenv(variable);
  if (list == nullptr) return;
  std::istringstream stream(list);
  for (std::string folder; std::getline(stream, folder, ':');)
    if (!folder.empty()) folders.emplace_back(folder);
}

bool isOnTheWeb(const std::string& uri) {
  const std::string scheme = common::lowerCase(uri.substr(0, uri.find("://")));
  return scheme == "http" || scheme == "https";
}

/// How a model is got from its server.
std::string howToDownload(const FuelAddress& address, const std::string& uri) {
  const bool official = address.server.ends_with("gazebosim.org") || address.server.ends_with("ignitionrobotics.org");
  if (!official) return fmt::format("download it from {}", uri);
  return fmt::format("download it with `gz fuel download -u \"https://fuel.gazebosim.org/1.0/{}/models/{}{}\"`",
                     address.owner, address.name, address.version.empty() ? "" : "/" + address.version);
}

/// The part after the scheme. The leading slashes of `model://` URIs, whose path is always relative, are removed.
std::string pathOf(const std::string& uri) {
  const auto scheme_end = uri.find("://");
  if (scheme_end == std::string::npos) return uri;
  std::string path = uri.substr(scheme_end + 3);
  if (uri.starts_with("model://")) path.erase(0, path.find_first_not_of('/'));
  return path;
}

}  // namespace

UriResolver::UriResolver(const fs::path& sdf_file, const std::vector<std::string>& model_paths)
    : folders_(model_paths.begin(), model_paths.end()) {
  for (const char* variable :
       {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH"})
    addFolders(variable, folders_);
  const fs::path folder = fs::absolute(sdf_file).parent_path();
  for (const fs::path& base : {folder, folder.parent_path()})
    for (const char* inside : {"", "models", "media"})
      if (base == folder || *inside != '\0') folders_.push_back(base / inside);
  folders_.push_back(folder.parent_path());  // The file of a bare model, models/NAME/model.sdf, uses uris such as
                                             // model://NAME/meshes/...
  folders_.emplace_back(".");
  for (const char* variable : {"GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"}) addFolders(variable, folders_);
  if (const char* home = std::getenv("HOME"))
    for (const char* cache : {".gz/fuel", ".ignition/fuel", ".gazebo/models"})
      folders_.push_back(fs::path(home) / cache);
}

/// Where the file of a URI may lie, the likeliest place first.
std::vector<UriResolver::Place> UriResolver::placesOf(const std::string& uri, const fs::path& used_in) const {
  std::vector<Place> places;
  const std::string raw = pathOf(uri);
  for (const std::string& path : {raw, percentDecoded(raw)}) {
    if (path.empty()) continue;
    if (fs::path(path).is_absolute()) {
      places.push_back({"/", path.substr(1)});
      continue;
    }
    if (!used_in.empty()) places.push_back({used_in.parent_path(), path});
    for (const fs::path& folder : folders_) places.push_back({folder, path});
    // A model finds its own files if its folder has another name, as each version in a cache of Fuel has.
    if (const auto slash = path.find('/');
        !used_in.empty() && uri.starts_with("model://") && slash != std::string::npos)
      places.push_back({used_in.parent_path(), path.substr(slash + 1)});
  }
  return places;
}

std::optional<fs::path> UriResolver::find(const std::string& uri, const fs::path& used_in) const {
  if (const auto address = fuelAddress(uri)) return findFuel(*address);
  if (isOnTheWeb(uri)) return std::nullopt;
  for (const auto& [folder, path] : placesOf(uri, used_in)) {
    std::error_code error;
    // A broken link is the intended file, and its reader reports it.
    if (fs::exists(folder / path, error) || fs::is_symlink(folder / path, error))
      return newestIn((folder / path).lexically_normal());
  }
  if (!uri.starts_with("model://")) return std::nullopt;
  const fs::path path = percentDecoded(pathOf(uri));
  fs::path inside;
  for (auto part = path.begin(); part != path.end(); ++part)
    if (part != path.begin()) inside /= *part;
  for (const fs::path& folder : folders_)
    if (const auto model = path.empty() ? std::nullopt : findNameInFuel(folder, path.begin()->string()))
      return findIgnoringCase(*model, inside);
  return std::nullopt;
}

std::optional<fs::path> UriResolver::findFuel(const FuelAddress& address) const {
  for (const fs::path& folder : folders_)
    if (const auto model = findModelOfFuel(folder, address))
      return address.inside.empty() ? model : findIgnoringCase(*model, address.inside);
  return std::nullopt;
}

std::string UriResolver::hintFor(const std::string& uri, const fs::path& used_in) const {
  if (std::string hint = common::misleadingHint(uri); !hint.empty()) return hint;
  std::vector<std::string> searched;
  for (const fs::path& folder : folders_)
    if (const std::string name = fs::absolute(folder / "").lexically_normal().parent_path().string();
        std::find(searched.begin(), searched.end(), name) == searched.end())
      searched.push_back(name);
  const std::string there = fmt::format(
      "give the folder that holds it as a model path (fly --model-path, a trial's "
      "model_paths) or in SDF_PATH; searched: {}",
      fmt::join(searched, ", "));
  if (const auto address = fuelAddress(uri)) {
    std::set<int> versions;
    for (const fs::path& folder : folders_) versions.merge(versionsOfFuel(folder, *address));
    const std::string there_are =
        versions.empty() ? "" : fmt::format("there is version {} of it: name that, or ", fmt::join(versions, ", "));
    return fmt::format("{}{}, or, as `{}`, {}", there_are, howToDownload(*address, uri), address->name, there);
  }
  if (isOnTheWeb(uri)) return "download it, and name the file instead";
  for (const auto& [folder, path] : placesOf(uri, used_in))
    if (const auto alike = findIgnoringCase(folder, path)) {
      const std::string whole = uri.ends_with(path) ? uri : percentDecoded(uri);
      return fmt::format("did you mean `{}{}`?", whole.substr(0, whole.size() - path.size()),
                         alike->lexically_relative(folder).string());
    }
  return there;
}

}  // namespace swiftlet::simulation
