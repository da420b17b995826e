#include "simulation/fuel_address.hpp"

#include <algorithm>
#include <charconv>

#include "common/lower_case.hpp"

namespace swiftlet::simulation {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> partsOf(std::string_view path) {
  std::vector<std::string> parts;
  while (!path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    if (slash > 0) parts.emplace_back(percentDecoded(path.substr(0, slash)));
    path.remove_prefix(std::min(slash + 1, path.size()));
  }
  return parts;
}

/// A version's number; none for other names.
std::optional<int> numberOf(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

bool isModelFolder(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / "model.config", ignored) || fs::exists(folder / "model.sdf", ignored);
}

/// In a model's folder of the cache each version has a folder of its own; a copy made by hand has no version folder.
std::optional<fs::path> versionIn(const fs::path& model, const std::string& wanted) {
  if (isModelFolder(model)) return model;
  std::optional<int> newest;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(model, ignored))
    if (const auto number = numberOf(entry.path().filename().string()); number && isModelFolder(entry.path()))
      newest = std::max(newest.value_or(*number), *number);
  const std::string version = wanted.empty() && newest ? std::to_string(*newest) : wanted;
  if (version.empty() || !isModelFolder(model / version)) return std::nullopt;
  return model / version;
}

}  // namespace

std::optional<FuelAddress> fuelAddress(std::string_view uri) {
  const std::size_t scheme_end = uri.find("://");
  if (scheme_end == std::string_view::npos) return std::nullopt;
  const std::string scheme = common::lowerCase(uri.substr(0, scheme_end));
  if (scheme != "https" && scheme != "http" && scheme != "fuel") return std::nullopt;
  const std::vector<std::string> parts = partsOf(uri.substr(scheme_end + 3));
  const auto models = std::find(parts.begin(), parts.end(), "models");
  if (parts.end() - models < 2 || models - parts.begin() < 2) return std::nullopt;
  // The server's page has OWNER/fuel/models or OWNER/models, its interface 1.0/OWNER/models.
  const bool versioned = parts[1].find('.') != std::string::npos && models - parts.begin() > 2;
  FuelAddress address{common::lowerCase(parts[0]), parts[versioned ? 2 : 1], models[1], {}, {}};
  auto rest = models + 2;
  if (rest != parts.end() && (numberOf(*rest) || *rest == "tip")) {
    if (*rest != "tip") address.version = *rest;
    ++rest;
  }
  if (rest != parts.end() && *rest == "files") ++rest;
  for (; rest != parts.end(); ++rest) address.inside += (address.inside.empty() ? "" : "/") + *rest;
  return address;
}

std::optional<fs::path> findIgnoringCase(const fs::path& folder, const fs::path& relative) {
  fs::path found = folder;
  std::error_code ignored;
  for (const fs::path& part : relative) {
    if (part.empty()) continue;
    if (!fs::exists(found / part, ignored)) {
      std::vector<fs::path> alike;
      for (const fs::directory_entry& entry : fs::directory_iterator(found, ignored))
        if (common::lowerCase(entry.path().filename().string()) == common::lowerCase(part.string()))
          alike.push_back(entry.path());
      if (alike.empty()) return std::nullopt;
      found = *std::min_element(alike.begin(), alike.end());
    } else {
      found /= part;
    }
  }
  return found;
}

namespace {

/// Where the folder of a model is, below a folder that may be a cache. The servers have had two names, under which the
/// same models lie.
std::vector<fs::path> foldersOf(const fs::path& folder, const FuelAddress& address) {
  const fs::path owned = fs::path(address.owner) / "models" / address.name;
  std::vector<fs::path> folders;
  for (const fs::path& place : {address.server / owned, "fuel.gazebosim.org" / owned,
                                "fuel.ignitionrobotics.org" / owned, owned, fs::path(address.name)})
    if (const auto model = findIgnoringCase(folder, place)) folders.push_back(*model);
  return folders;
}

}  // namespace

std::optional<fs::path> findModelOfFuel(const fs::path& folder, const FuelAddress& address) {
  for (const fs::path& model : foldersOf(folder, address))
    if (auto found = versionIn(model, address.version)) return found;
  return std::nullopt;
}

fs::path newestIn(const fs::path& model) { return versionIn(model, "").value_or(model); }

std::optional<fs::path> findNameInFuel(const fs::path& folder, const std::string& name) {
  std::set<std::string> owners;
  std::optional<fs::path> found;
  std::error_code ignored;
  for (const char* server : {"fuel.gazebosim.org", "fuel.ignitionrobotics.org"})
    for (const fs::directory_entry& owner : fs::directory_iterator(folder / server, ignored)) {
      const auto model = findIgnoringCase(owner.path(), fs::path("models") / name);
      if (!model || !versionIn(*model, "")) continue;
      owners.insert(owner.path().filename().string());
      if (!found) found = newestIn(*model);
    }
  return owners.size() == 1 ? found : std::nullopt;
}

std::set<int> versionsOfFuel(const fs::path& folder, const FuelAddress& address) {
  std::set<int> versions;
  std::error_code ignored;
  for (const fs::path& model : foldersOf(folder, address))
    for (const fs::directory_entry& entry : fs::directory_iterator(model, ignored))
      if (const auto number = numberOf(entry.path().filename().string()); number && isModelFolder(entry.path()))
        versions.insert(*number);
  return versions;
}

}  // namespace swiftlet::simulation
