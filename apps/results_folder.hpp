// The folder that `swiftlet map`, `localize` or `optimize` writes into.
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
  std::string proof;               ///< The file by which older results are known to be ours: "report.html",
  std::string proof_text;          ///< and what it has near its beginning: "<title>Map of ".
  std::vector<std::string> files;  ///< The names of all they can have.
};

/// Held by one run at a time. One that was made for it and stayed empty is gone with it.
///
///   made --> results are written into unfinished() --> publish(): they take the place of older ones
///                 \-> the end without publish(), or a kill: older ones stand; what was begun is removed, at the latest
///                     by the next run
class ResultsFolder {
 public:
  /// Makes the folder. One that is there must be writable and be empty or hold older results of that kind; anything
  /// else is refused. Throws InputError that says why.
  ResultsFolder(std::filesystem::path path, const ResultsKind& kind);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// A folder within, for the results as long as some are missing.
  const std::filesystem::path& unfinished() const { return unfinished_; }
  /// Puts the results in the place of older ones, by renames within one file system; older ones that have no successor
  /// are removed. Links among them are replaced, not followed. Throws InputError when that fails.
  void publish();

 private:
  void refuseWhatIsNotOurs() const;

  std::filesystem::path path_, unfinished_;
  ResultsKind kind_;
  bool made_ = false;
  std::optional<interfaces::FolderLock> lock_;
};

}  // namespace swiftlet::apps
