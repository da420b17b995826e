// The folder that `swiftlet map` writes into.
#pragma once

#include <filesystem>
#include <optional>

#include "interfaces/files/folder_lock.hpp"

namespace swiftlet::apps {

/// Held by one run at a time. One that was made for it and stayed empty is gone with it.
class MapFolder {
 public:
  /// Makes the folder. One that is there must be empty or hold an older map, whose files are replaced when the new one
  /// is written; anything else is refused. Throws InputError that says why.
  explicit MapFolder(std::filesystem::path path);
  ~MapFolder();
  MapFolder(const MapFolder&) = delete;
  MapFolder& operator=(const MapFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  void refuseWhatIsNoMap() const;

  std::filesystem::path path_;
  bool made_ = false;
  std::optional<interfaces::FolderLock> lock_;
};

}  // namespace swiftlet::apps
