// Keeps two processes, or two flights of one process, from writing into one folder. The lock ends with its holder, even
// if that is killed. On file systems without locks every request succeeds.
#pragma once

#include <filesystem>

namespace swiftlet::interfaces {

class FolderLock {
 public:
  /// Does not wait for a lock. The folder must exist.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

  /// Another process or flight holds the folder.
  bool refused() const { return refused_; }

 private:
  int descriptor_ = -1;
  bool refused_ = false;
};

}  // namespace swiftlet::interfaces
