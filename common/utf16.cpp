#include "common/utf16.hpp"

#include <utility>

namespace swiftlet::common {
namespace {

constexpr std::uint32_t kNoCharacter = 0xfffd;
constexpr std::uint32_t kByteOrderMark = 0xfeff;

}  // namespace

std::optional<ByteOrder> utf16OrderOf(std::string_view beginning) {
  if (beginning.starts_with("\xff\xfe")) return ByteOrder::kLittleEndian;
  if (beginning.starts_with("\xfe\xff")) return ByteOrder::kBigEndian;
  return std::nullopt;
}

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

void Utf16Decoder::decode(std::string_view bytes, std::string& utf8) {
  for (const char byte : bytes) take(static_cast<std::uint8_t>(byte), utf8);
}

void Utf16Decoder::finish(std::string& utf8) const {
  if (half_ || high_ != 0) appendUtf8(utf8, kNoCharacter);
}

void Utf16Decoder::take(std::uint32_t byte, std::string& utf8) {
  if (!half_) {
    half_ = byte;
    return;
  }
  const std::uint32_t unit = order_ == ByteOrder::kBigEndian ? *half_ << 8 | byte : byte << 8 | *half_;
  half_.reset();
  const bool is_low = unit >= 0xdc00 && unit < 0xe000;
  if (high_ != 0 && is_low) {
    appendUtf8(utf8, 0x10000 + ((high_ - 0xd800) << 10) + (unit - 0xdc00));
    high_ = 0;
    return;
  }
  if (high_ != 0) appendUtf8(utf8, kNoCharacter);
  high_ = unit >= 0xd800 && unit < 0xdc00 ? unit : 0;
  const bool is_mark = std::exchange(at_begin_, false) && unit == kByteOrderMark;
  if (high_ == 0 && !is_mark) appendUtf8(utf8, is_low ? kNoCharacter : unit);
}

}  // namespace swiftlet::common
