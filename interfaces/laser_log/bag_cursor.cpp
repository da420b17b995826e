#include "interfaces/laser_log/bag_cursor.hpp"

#include <algorithm>
#include <bit>

namespace swiftlet::interfaces {
namespace {

constexpr std::size_t kBagBlockBytes = std::size_t{1} << 16;

}  // namespace

std::uint32_t MessageCursor::u32() {
  std::uint32_t value = 0;
  int shift = 0;
  for (const char byte : bytes(4)) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(byte)) << shift;
    shift += 8;
  }
  return value;
}

float MessageCursor::f32() { return std::bit_cast<float>(u32()); }

std::string_view MessageCursor::bytes(std::size_t count) {
  if (count > left_.size()) {
    whole_ = false;
    left_ = {};
    return {};
  }
  const std::string_view taken = left_.substr(0, count);
  left_.remove_prefix(count);
  return taken;
}

std::string_view StreamCursor::bytes(std::size_t count) {
  while (buffer_.size() - taken_ < count)
    if (!fill()) throw StreamFailure{"it ends within a record"};
  const std::string_view taken = std::string_view(buffer_).substr(taken_, count);
  taken_ += count;
  offset_ += count;
  return taken;
}

void StreamCursor::skip(std::uint64_t count) {
  while (count > 0) {
    const std::size_t ready = std::min<std::uint64_t>(count, buffer_.size() - taken_);
    taken_ += ready;
    offset_ += ready;
    count -= ready;
    if (count > 0 && !fill()) throw StreamFailure{"it ends within a record"};
  }
}

BytesRead StreamCursor::some(char* to, std::size_t count) {
  try {
    if (taken_ == buffer_.size() && !fill()) return 0;
  } catch (const StreamFailure& failure) {
    return tl::unexpected(failure.message);
  }
  const std::size_t ready = std::min(count, buffer_.size() - taken_);
  std::copy_n(buffer_.data() + taken_, ready, to);
  taken_ += ready;
  offset_ += ready;
  return ready;
}

bool StreamCursor::atEnd() { return taken_ == buffer_.size() && !fill(); }

bool StreamCursor::fill() {
  buffer_.erase(0, std::exchange(taken_, 0));
  const std::size_t before = buffer_.size();
  buffer_.resize(before + kBagBlockBytes);
  const BytesRead count = source_(buffer_.data() + before, kBagBlockBytes);
  buffer_.resize(before + count.value_or(0));
  if (!count) throw StreamFailure{count.error()};
  return *count > 0;
}

}  // namespace swiftlet::interfaces
