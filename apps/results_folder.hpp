// The folder that `swiftlet map`, `localize` or `optimize` writes into.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "interfaces/files/folder_lock.hpp"

namespace swiftlet::apps {

/// How the results of a command are recognized.
struct ResultsKind {
  std::string noun;                ///< The kind of results: "map".
  std::string proof;               ///< The file by which older results are recognized: "report.html".
  std::string proof_text;          ///< Text near the beginning of that file: "<title>Map of ".
  std::vector<std::string> files;  ///< The names of all files that results can have.
};

/// One run at a time holds it. A folder that was made for it and stayed empty is removed with it.
///
///   made --> results are written into unfinished() --> publish(): they replace older ones
///                \-> the end without publish(), or a kill: older results stay; unfinished ones are removed,
///                    at the latest by the next run
class ResultsFolder {
 public:
  /// Makes the folder. An existing one must be writable, and be empty or contain older results of that kind; anything
  /// else is refused. Throws InputError with the reason.
  ResultsFolder(std::filesystem::path path, const ResultsKind& kind);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// A folder within, for the results until all are written.
  const std::filesystem::path& unfinished() const { return unfinished_; }
  /// Replaces older results by the new ones, by renames within one file system; older ones without a successor are
  /// removed. Links among them are replaced, not followed. Throws InputError if that fails.
  void publish();

 private:
  void refuseForeignFiles() const;

  std::filesystem::path path_, unfinished_;
  ResultsKind kind_;
  bool made_ = false;
  std::optional<interfaces::FolderLock> lock_;
};

}  // namespace swiftlet::apps
