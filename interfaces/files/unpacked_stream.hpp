// The bytes of a file, plain or compressed by gzip, bzip2 or xz (told by its bytes, not by its name), unpacked as it
// goes: the memory it takes does not depend on the file's size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

struct archive;

namespace swiftlet::interfaces {

/// How many bytes were read, at most those asked for and 0 only at the end; or why no more can be.
using BytesRead = tl::expected<std::size_t, std::string>;
/// Where packed bytes come from.
using ByteSource = std::function<BytesRead(char* to, std::size_t bytes)>;

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

  /// An error says that the archive is cut or damaged; what came before it was returned.
  /// (The checksum of gzip is not verified: damage that leaves it decodable is not seen.)
  BytesRead read(char* to, std::size_t bytes);
  /// Of the file as it lies on the disk, for a progress bar.
  std::int64_t packedBytesRead() const;
  const std::string& name() const { return name_; }

 private:
  struct ArchiveDeleter {
    void operator()(struct archive* opened) const;
  };
  struct Feed;

  explicit UnpackedStream(std::string name);
  void begin(int open_result);
  std::string archiveError() const;

  std::string name_;
  std::unique_ptr<Feed> feed_;
  std::unique_ptr<struct archive, ArchiveDeleter> archive_;
  std::string failure_;  ///< Of the first header; told by the first read.
  bool at_end_ = false;
};

}  // namespace swiftlet::interfaces
