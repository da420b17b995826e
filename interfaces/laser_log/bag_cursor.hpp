// Little-endian bytes: out of a stream of any length, and out of what is in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "interfaces/files/unpacked_stream.hpp"

namespace swiftlet::interfaces {

/// Numbers and texts of a message in memory. Past its end everything is zero and empty, and `whole()` false.
class MessageCursor {
 public:
  explicit MessageCursor(std::string_view bytes) : left_(bytes) {}

  std::uint32_t u32();
  float f32();
  std::string_view bytes(std::size_t count);
  std::string_view text() { return bytes(u32()); }
  bool whole() const { return whole_; }
  std::size_t left() const { return left_.size(); }

 private:
  std::string_view left_;
  bool whole_ = true;
};

/// Why a stream gave fewer bytes than were asked for.
struct StreamFailure {
  std::string message;
};

/// What is read is held only until the next call.
class StreamCursor {
 public:
  explicit StreamCursor(ByteSource source) : source_(std::move(source)) {}

  /// Throws StreamFailure when the stream ends before, or cannot be read on.
  std::string_view bytes(std::size_t count);
  std::uint32_t u32() { return MessageCursor(bytes(4)).u32(); }
  void skip(std::uint64_t count);
  /// Up to `count` bytes as they come, for a stream in this one.
  BytesRead some(char* to, std::size_t count);
  /// Throws StreamFailure when that cannot be told.
  bool atEnd();
  /// Of the bytes taken so far.
  std::uint64_t offset() const { return offset_; }

 private:
  /// Makes more bytes ready; false at the end.
  bool fill();

  ByteSource source_;
  std::string buffer_;
  std::size_t taken_ = 0;
  std::uint64_t offset_ = 0;
};

}  // namespace swiftlet::interfaces
