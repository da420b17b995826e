// The folder that `swiftlet map` or `swiftlet localize` writes into.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "interfaces/files/folder_lock.hpp"

namespace swiftlet::apps {

/// What results of a command are known by.
struct ResultsKind {
  std::string noun;                ///< "map".
  std::string title;               ///< What the title of their report.html begins with: "Map of ".
  std::vector<std::string> files;  ///< The names of all they can have.
};

/// Held by one run at a time. One that was made for it and stayed empty is gone with it.
class ResultsFolder {
 public:
  /// Makes the folder. One that is there must be empty or hold older results of that kind, whose files are replaced
  /// when the new ones are written; anything else is refused. Throws InputError that says why.
  ResultsFolder(std::filesystem::path path, const ResultsKind& kind);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  void refuseWhatIsNot(const ResultsKind& kind) const;

  std::filesystem::path path_;
  bool made_ = false;
  std::optional<interfaces::FolderLock> lock_;
};

}  // namespace swiftlet::apps
