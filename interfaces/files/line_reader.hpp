// The lines of a text file, plain or compressed by gzip, bzip2 or xz (recognized by its bytes, not by its name). It is
// unpacked as a stream: the memory used does not depend on the file's size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "common/error.hpp"
#include "interfaces/files/unpacked_stream.hpp"

namespace swiftlet::interfaces {

struct LineLimits {
  std::size_t line_bytes = std::size_t{1} << 20;    ///< A longer line is refused, or cut.
  std::int64_t file_bytes = std::int64_t{4} << 30;  ///< A file that unpacks to more bytes is refused.
  bool cut_long_lines = false;  ///< Only the beginning of a longer line is returned; the rest is not stored.
};

/// Used by one thread.
class LineReader {
 public:
  /// Throws InputError if the file is not a regular file or cannot be opened.
  explicit LineReader(const std::filesystem::path& file, LineLimits limits = {});
  /// Reads `bytes` as if a file named `name` contained them. They must outlive the reader.
  static LineReader fromBytes(std::string_view bytes, std::string name, LineLimits limits = {});

  /// The next line without its end (a newline, or carriage return and newline); false after the last. The view is valid
  /// until the next call. A last line without an end is returned, unless it is empty. A byte order mark is not part of
  /// the first line. Throws InputError if a line or the file is too long, or if compressed data are cut or damaged,
  /// after the lines before that.
  bool next(std::string_view& line);

  /// Number of the last line returned, counted from 1; 0 before the first. It stops at the greatest int.
  int lineNumber() const { return line_number_; }
  /// The last line returned was too long, and only its beginning was returned.
  bool lineCut() const { return line_cut_; }
  const std::string& name() const { return stream_.name(); }
  /// Bytes of the file on the disk, for a progress bar.
  std::int64_t packedBytesRead() const { return stream_.packedBytesRead(); }

  /// A problem in the last line returned, to throw. Columns count from 1; 0 stands for the whole line.
  common::InputError problemAt(int column, std::string element, common::Message message, std::string hint = "") const;

 private:
  LineReader(UnpackedStream stream, LineLimits limits) : stream_(std::move(stream)), limits_(limits) {}
  void readBlock();
  void dropRestOfLine();

  UnpackedStream stream_;
  LineLimits limits_;
  std::string buffer_;
  std::size_t taken_ = 0;  ///< How many of the buffer's bytes were returned.
  std::int64_t unpacked_bytes_ = 0;
  bool at_end_ = false;
  bool line_cut_ = false;
  int line_number_ = 0;
};

}  // namespace swiftlet::interfaces
