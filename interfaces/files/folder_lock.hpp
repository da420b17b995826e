// Keeps two processes, or two flights of one, from writing into one folder. Ends with its holder, also with one that is
// killed. File systems that know no locks give none, and everybody the folder.
#pragma once

#include <filesystem>

namespace swiftlet::interfaces {

class FolderLock {
 public:
  /// Does not wait. The folder must exist.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

  /// Somebody else holds the folder.
  bool refused() const { return refused_; }

 private:
  int descriptor_ = -1;
  bool refused_ = false;
};

}  // namespace swiftlet::interfaces
