// The lines of a text file, plain or compressed by gzip, bzip2 or xz (told by its bytes, not by its name), unpacked as
// it goes: the memory it takes does not depend on the file's size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "common/error.hpp"

struct archive;

namespace swiftlet::interfaces {

struct LineLimits {
  std::size_t line_bytes = std::size_t{1} << 20;    ///< A longer line is refused.
  std::int64_t file_bytes = std::int64_t{4} << 30;  ///< A file that unpacks to more is refused.
};

/// Used by one thread.
class LineReader {
 public:
  /// Throws InputError when the file is no regular file or cannot be opened.
  explicit LineReader(const std::filesystem::path& file, LineLimits limits = {});
  /// Reads `bytes`, which must outlive the reader, as if a file named `name` held them.
  static LineReader fromBytes(std::string_view bytes, std::string name, LineLimits limits = {});
  ~LineReader();
  LineReader(LineReader&&) noexcept;
  LineReader& operator=(LineReader&&) noexcept;

  /// The next line without its end (a newline, or carriage return and newline); false after the last. The view holds
  /// until the next call. A last line without an end is a line; one that is empty is none. Throws InputError when a
  /// line or the file is too long, or when what is compressed is cut or damaged; the lines before that were returned.
  /// (The checksum of gzip is not verified: damage that leaves it decodable is not seen.)
  bool next(std::string_view& line);

  /// Of the line returned last, counted from 1; 0 before the first.
  int lineNumber() const { return line_number_; }
  /// Whether the line returned last had its newline; the last one of a killed writer may not.
  bool lineEnded() const { return line_ended_; }
  const std::string& name() const { return name_; }
  /// Of the file as it lies on the disk, for a progress bar.
  std::int64_t packedBytesRead() const;

  /// A problem in the line returned last, to be thrown; columns count from 1, 0 for the whole line.
  common::InputError problemAt(int column, std::string element, std::string message, std::string hint = "") const;

 private:
  struct ArchiveDeleter {
    void operator()(struct archive* opened) const;
  };

  LineReader(std::string name, LineLimits limits);
  void begin(int open_result);
  void readBlock();
  common::InputError unpackingProblem() const;

  std::string name_;
  LineLimits limits_;
  std::unique_ptr<struct archive, ArchiveDeleter> archive_;
  std::string buffer_;
  std::size_t taken_ = 0;  ///< Of the buffer's bytes, those that were returned.
  std::int64_t unpacked_bytes_ = 0;
  bool at_end_ = false;
  bool line_ended_ = true;
  int line_number_ = 0;
};

}  // namespace swiftlet::interfaces
