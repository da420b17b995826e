// Little-endian bytes, from a stream of any length or from memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "interfaces/files/unpacked_stream.hpp"

namespace swiftlet::interfaces {

/// Numbers and texts of a message in memory. Past its end everything is zero or empty, and `whole()` is false.
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

/// The bytes read are valid only until the next call.
class StreamCursor {
 public:
  explicit StreamCursor(ByteSource source) : source_(std::move(source)) {}

  /// Throws StreamFailure if the stream ends too early or cannot be read on.
  std::string_view bytes(std::size_t count);
  std::uint32_t u32() { return MessageCursor(bytes(4)).u32(); }
  void skip(std::uint64_t count);
  /// Up to `count` bytes, for a stream inside this one.
  BytesRead some(char* to, std::size_t count);
  /// Whether the stream has ended. Throws StreamFailure if it cannot be read on.
  bool atEnd();
  /// Number of bytes taken so far.
  std::uint64_t offset() const { return offset_; }

 private:
  /// Makes more bytes available; false at the end.
  bool fill();

  ByteSource source_;
  std::string buffer_;
  std::size_t taken_ = 0;
  std::uint64_t offset_ = 0;
};

}  // namespace swiftlet::interfaces
