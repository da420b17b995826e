// Files that are never seen half written: whole files by a temporary one and a rename, growing files by whole records.
// Failures (full disk, missing rights) are returned, not thrown, so that they can be handled in flight.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>

#include <tl/expected.hpp>

#include "common/message.hpp"

namespace swiftlet::interfaces {

/// Why a file could not be written: "out/map.pgm: No space left on device".
struct FileError {
  common::Message message;
  std::error_code why = {};  ///< Empty if the system is not the cause.
};
using Written = tl::expected<void, FileError>;

/// What the file must survive: a killed process, or also a power cut, which is slower because it waits for the disk.
enum class Durability { kProcess, kPower };

/// Replaces `file` by `bytes` in one step: readers see the old content or the new one. If it fails, the old content
/// stays and nothing else is left. The folder must exist.
[[nodiscard]] Written writeAtomically(const std::filesystem::path& file, std::string_view bytes,
                                      Durability durability = Durability::kProcess);

using WriteBytes = std::function<void(std::string_view bytes)>;
/// The same for bytes that are not all in memory at once: `content` hands them on piece by piece. It must not throw.
[[nodiscard]] Written writeAtomically(const std::filesystem::path& file,
                                      const std::function<void(const WriteBytes& write)>& content,
                                      Durability durability = Durability::kProcess);

/// Whether writeAtomically() could replace `file` now: makes its temporary file and removes it again.
[[nodiscard]] Written tryToWrite(const std::filesystem::path& file);

/// A file that grows by whole records. Each record is handed to the kernel before `append` returns. A record that does
/// not fit on the disk is removed again. Used by one thread.
class AppendFile {
 public:
  /// Starts an empty file. An older file of that name is replaced; a link is not followed.
  [[nodiscard]] static tl::expected<AppendFile, FileError> create(const std::filesystem::path& file);
  ~AppendFile();
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;

  [[nodiscard]] Written append(std::string_view record);

 private:
  AppendFile(std::filesystem::path file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {}
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace swiftlet::interfaces
