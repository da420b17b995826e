#include "common/printable.hpp"

#include <cstddef>

#include <fmt/format.h>

namespace swiftlet::common {
namespace {

unsigned char byteAt(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

bool isContinuation(std::string_view text, std::size_t i) {
  return i < text.size() && (byteAt(text, i) & 0xC0U) == 0x80U;
}

/// Length in bytes of the UTF-8 character at `i`; 0 if it may not be shown. Overlong forms, surrogates and
/// values beyond Unicode are invalid (RFC 3629).
std::size_t shownBytes(std::string_view text, std::size_t i) {
  const unsigned char first = byteAt(text, i);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if (!isContinuation(text, i + k)) return 0;
  const unsigned char second = byteAt(text, i + 1);
  if (first == 0xC2 && second < 0xA0) return 0;  // C1.
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F)) return 0;
  if ((first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) return 0;
  return length;
}

std::string escaped(unsigned char byte) {
  if (byte == '\n') return "\\n";
  if (byte == '\r') return "\\r";
  if (byte == '\t') return "\\t";
  return fmt::format("\\x{:02x}", byte);
}

std::string shown(std::string_view text, std::string_view kept) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    if (kept.find(text[i]) != std::string_view::npos) {
      result += text[i++];
    } else if (const std::size_t bytes = shownBytes(text, i); bytes > 0) {
      result += text.substr(i, bytes);
      i += bytes;
    } else {
      result += escaped(byteAt(text, i++));
    }
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) { return shown(text, ""); }

std::string printableLines(std::string_view text) { return shown(text, "\n\t"); }

}  // namespace swiftlet::common
