// The bytes of a file, plain or compressed by gzip, bzip2 or xz (recognized by its bytes, not by its name). It is
// unpacked as a stream: the memory used does not depend on the file's size. A text in UTF-16 with its byte order mark
// comes as UTF-8.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "common/read_bytes.hpp"
#include "interfaces/files/byte_source.hpp"

struct archive;

namespace swiftlet::interfaces {

/// Used by one thread.
class UnpackedStream {
 public:
  /// Throws InputError if the file is not a regular file, cannot be opened, or holds a pointer of Git LFS or git-annex.
  explicit UnpackedStream(const std::filesystem::path& file);
  /// Reads `bytes` as if a file named `name` contained them. They must outlive this.
  static UnpackedStream fromBytes(std::string_view bytes, std::string name);
  /// Reads a chunk of a bag from `source`, which may be packed by lz4, too, and is no text.
  static UnpackedStream fromSource(ByteSource source, std::string name);
  ~UnpackedStream();
  UnpackedStream(UnpackedStream&&) noexcept;
  UnpackedStream& operator=(UnpackedStream&&) noexcept;

  /// An error says that packed data are cut or damaged, or that something else follows them; the bytes before that were
  /// returned.
  BytesRead read(char* to, std::size_t bytes);
  /// Bytes of the file on the disk, for a progress bar.
  std::int64_t packedBytesRead() const;
  const std::string& name() const { return name_; }

 private:
  struct ArchiveDeleter {
    void operator()(struct archive* opened) const;
  };
  struct Feed;

  UnpackedStream(ByteSource packed, std::string name, bool is_chunk);
  void unpackBlock();
  std::string archiveError() const;

  std::string name_;
  std::unique_ptr<Feed> feed_;
  std::unique_ptr<struct archive, ArchiveDeleter> archive_;
  std::string_view unpacked_;  ///< Owned by the library; valid until it is asked for more.
  std::string failure_;        ///< A failure when opening, reported by the first read.
  bool at_end_ = false;
};

/// Endings of compressed files.
inline constexpr std::array kPackedEndings{".gz", ".bz2", ".xz"};
/// The name of a file without the ending of its compression: "map.bt.gz" -> "map.bt".
std::filesystem::path unpackedName(const std::filesystem::path& file);

/// All bytes of a file, unpacked. Throws InputError if it cannot be opened, if it is cut or damaged, or if it holds
/// more than `most_bytes`.
std::string readUnpacked(const std::filesystem::path& file, std::size_t most_bytes = common::kMostFileBytes);

}  // namespace swiftlet::interfaces
