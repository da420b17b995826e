// The lines of a text file, plain or compressed by gzip, bzip2 or xz (told by its bytes, not by its name), unpacked as
// it goes: the memory it takes does not depend on the file's size.
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
  std::int64_t file_bytes = std::int64_t{4} << 30;  ///< A file that unpacks to more is refused.
  bool cut_long_lines = false;                      ///< Only the begin of a longer line is returned, the rest not held.
};

/// Used by one thread.
class LineReader {
 public:
  /// Throws InputError when the file is no regular file or cannot be opened.
  explicit LineReader(const std::filesystem::path& file, LineLimits limits = {});
  /// Reads `bytes`, which must outlive the reader, as if a file named `name` held them.
  static LineReader fromBytes(std::string_view bytes, std::string name, LineLimits limits = {});

  /// The next line without its end (a newline, or carriage return and newline); false after the last. The view holds
  /// until the next call. A last line without an end is a line; one that is empty is none. A byte order mark is no part
  /// of the first. Throws InputError when a line or the file is too long, or when what is compressed is cut or damaged;
  /// the lines before that were returned.
  bool next(std::string_view& line);

  /// Of the line returned last, counted from 1; 0 before the first. Stays at the greatest int.
  int lineNumber() const { return line_number_; }
  /// Whether the line returned last was longer than it may be and is only its begin.
  bool lineCut() const { return line_cut_; }
  const std::string& name() const { return stream_.name(); }
  /// Of the file as it lies on the disk, for a progress bar.
  std::int64_t packedBytesRead() const { return stream_.packedBytesRead(); }

  /// A problem in the line returned last, to be thrown; columns count from 1, 0 for the whole line.
  common::InputError problemAt(int column, std::string element, std::string message, std::string hint = "") const;

 private:
  LineReader(UnpackedStream stream, LineLimits limits) : stream_(std::move(stream)), limits_(limits) {}
  void readBlock();
  void dropRestOfLine();

  UnpackedStream stream_;
  LineLimits limits_;
  std::string buffer_;
  std::size_t taken_ = 0;  ///< Of the buffer's bytes, those that were returned.
  std::int64_t unpacked_bytes_ = 0;
  bool at_end_ = false;
  bool line_cut_ = false;
  int line_number_ = 0;
};

}  // namespace swiftlet::interfaces
