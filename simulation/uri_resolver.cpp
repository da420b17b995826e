#include "simulation/uri_resolver.hpp"

#include <cstdlib>
#include <sstream>

namespace swiftlet::simulation {
namespace fs = std::filesystem;
namespace {

void addFolders(const char* list, std::vector<fs::path>& folders) {
  if (list == nullptr) return;
  std::istringstream stream(list);
  for (std::string folder; std::getline(stream, folder, ':');)
    if (!folder.empty()) folders.emplace_back(folder);
}

/// The part after the scheme. The leading slashes of `model://` URIs, whose path is always relative, are removed.
std::string pathOf(const std::string& uri) {
  const auto scheme_end = uri.find("://");
  if (scheme_end == std::string::npos) return uri;
  std::string path = uri.substr(scheme_end + 3);
  if (uri.starts_with("model://")) path.erase(0, path.find_first_not_of('/'));
  return path;
}

std::optional<fs::path> existing(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  return path.lexically_normal();
}

}  // namespace

UriResolver::UriResolver(const fs::path& sdf_file, const std::vector<std::string>& model_paths)
    : folders_(model_paths.begin(), model_paths.end()) {
  addFolders(std::getenv("SDF_PATH"), folders_);
  const fs::path folder = fs::absolute(sdf_file).parent_path();
  for (const fs::path& base : {folder, folder.parent_path()})
    for (const char* inside : {"", "models", "media"})
      if (base == folder || *inside != '\0') folders_.push_back(base / inside);
  folders_.push_back(folder.parent_path());  // The file of a bare model, models/NAME/model.sdf, uses uris such as
                                             // model://NAME/meshes/...
}

std::optional<fs::path> UriResolver::find(const std::string& uri, const fs::path& used_in) const {
  if (uri.starts_with("http://") || uri.starts_with("https://")) return std::nullopt;
  const fs::path path = pathOf(uri);
  if (path.empty()) return std::nullopt;
  if (path.is_absolute()) return existing(path);
  if (!used_in.empty())
    if (auto found = existing(used_in.parent_path() / path)) return found;
  for (const fs::path& folder : folders_)
    if (auto found = existing(folder / path)) return found;
  return std::nullopt;
}

std::string UriResolver::findInclude(const std::string& uri) const {
  const auto found = find(uri);
  return found ? found->string() : std::string();
}

}  // namespace swiftlet::simulation
