// The bytes of a file, plain or compressed by gzip, bzip2 or xz (told by its bytes, not by its name), unpacked as it
// goes: the memory it takes does not depend on the file's size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "interfaces/files/byte_source.hpp"

struct archive;

namespace swiftlet::interfaces {

/// Used by one thread.
class UnpackedStream {
 public:
  /// Throws InputError when the file is no regular file or cannot be opened.
  explicit UnpackedStream(const std::filesystem::path& file);
  /// Reads `bytes`, which must outlive this, as if a file named `name` held them.
  static UnpackedStream fromBytes(std::string_view bytes, std::string name);
  /// Reads what `source` gives; also lz4, which chunks of bags are packed by.
  static UnpackedStream fromSource(ByteSource source, std::string name);
  ~UnpackedStream();
  UnpackedStream(UnpackedStream&&) noexcept;
  UnpackedStream& operator=(UnpackedStream&&) noexcept;

  /// An error says that what is packed is cut or damaged, or that something else follows it; what came before was
  /// returned.
  BytesRead read(char* to, std::size_t bytes);
  /// Of the file as it lies on the disk, for a progress bar.
  std::int64_t packedBytesRead() const;
  const std::string& name() const { return name_; }

 private:
  struct ArchiveDeleter {
    void operator()(struct archive* opened) const;
  };
  struct Feed;

  UnpackedStream(ByteSource packed, std::string name, bool may_be_lz4);
  void unpackBlock();
  std::string archiveError() const;

  std::string name_;
  std::unique_ptr<Feed> feed_;
  std::unique_ptr<struct archive, ArchiveDeleter> archive_;
  std::string_view unpacked_;  ///< The library's, until it is asked for more.
  std::string failure_;        ///< Met already when it was opened: told by the first read.
  bool at_end_ = false;
};

}  // namespace swiftlet::interfaces
