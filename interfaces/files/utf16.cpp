#include "interfaces/files/utf16.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <utility>

namespace swiftlet::interfaces {
namespace {

constexpr std::uint32_t kNoCharacter = 0xfffd;
constexpr std::uint32_t kByteOrderMark = 0xfeff;

void appendUtf8(std::string& text, std::uint32_t character) {
  const auto byte = [&](std::uint32_t bits) { text.push_back(static_cast<char>(bits)); };
  if (character < 0x80) return byte(character);
  if (character < 0x800) {
    byte(0xc0 | character >> 6);
  } else {
    if (character < 0x10000) {
      byte(0xe0 | character >> 12);
    } else {
      byte(0xf0 | character >> 18);
      byte(0x80 | (character >> 12 & 0x3f));
    }
    byte(0x80 | (character >> 6 & 0x3f));
  }
  byte(0x80 | (character & 0x3f));
}

class Utf16Decoder {
 public:
  Utf16Decoder(ByteSource source, ByteOrder order) : source_(std::move(source)), order_(order) {}

  BytesRead operator()(char* to, std::size_t bytes) {
    while (text_.empty() && !at_end_ && bytes > 0) {
      std::array<char, 4096> block{};
      const BytesRead count = source_(block.data(), block.size());
      if (!count) return count;
      at_end_ = *count == 0;
      for (const char byte : std::string_view(block.data(), *count)) take(static_cast<std::uint8_t>(byte));
      if (at_end_ && (half_ || high_ != 0)) appendUtf8(text_, kNoCharacter);
    }
    const std::size_t taken = text_.copy(to, bytes);
    text_.erase(0, taken);
    return taken;
  }

 private:
  void take(std::uint32_t byte) {
    if (!half_) {
      half_ = byte;
      return;
    }
    const std::uint32_t unit = order_ == ByteOrder::kBigEndian ? *half_ << 8 | byte : byte << 8 | *half_;
    half_.reset();
    const bool is_low = unit >= 0xdc00 && unit < 0xe000;
    if (high_ != 0 && is_low) {
      appendUtf8(text_, 0x10000 + ((high_ - 0xd800) << 10) + (unit - 0xdc00));
      high_ = 0;
      return;
    }
    if (high_ != 0) appendUtf8(text_, kNoCharacter);
    high_ = unit >= 0xd800 && unit < 0xdc00 ? unit : 0;
    const bool is_mark = std::exchange(at_begin_, false) && unit == kByteOrderMark;
    if (high_ == 0 && !is_mark) appendUtf8(text_, is_low ? kNoCharacter : unit);
  }

  ByteSource source_;
  ByteOrder order_;
  std::string text_;                   ///< Decoded, and not yet returned.
  std::optional<std::uint32_t> half_;  ///< The first byte of a unit.
  std::uint32_t high_ = 0;             ///< The first unit of a pair; 0 if there is none.
  bool at_begin_ = true;
  bool at_end_ = false;
};

}  // namespace

std::optional<ByteOrder> utf16OrderOf(std::string_view beginning) {
  if (beginning.starts_with("\xff\xfe")) return ByteOrder::kLittleEndian;
  if (beginning.starts_with("\xfe\xff")) return ByteOrder::kBigEndian;
  return std::nullopt;
}

ByteSource utf8From(ByteSource utf16, ByteOrder order) { return Utf16Decoder(std::move(utf16), order); }

}  // namespace swiftlet::interfaces
