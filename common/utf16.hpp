// Texts in UTF-16, as editors and shells of Windows save them, as UTF-8.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace swiftlet::common {

enum class ByteOrder { kLittleEndian, kBigEndian };

/// By the byte order mark that a text begins with; none for any other beginning.
std::optional<ByteOrder> utf16OrderOf(std::string_view beginning);

/// Appends a character, given by its number in Unicode.
void appendUtf8(std::string& text, std::uint32_t character);

/// A text that comes in parts, which may end anywhere. The byte order mark is left out; what is not a character becomes
/// U+FFFD.
class Utf16Decoder {
 public:
  explicit Utf16Decoder(ByteOrder order) : order_(order) {}

  /// Appends what the next bytes complete.
  void decode(std::string_view bytes, std::string& utf8);
  /// To call at the end of the text, which may be within a character.
  void finish(std::string& utf8) const;

 private:
  void take(std::uint32_t byte, std::string& utf8);

  ByteOrder order_;
  std::optional<std::uint32_t> half_;  ///< The first byte of a unit.
  std::uint32_t high_ = 0;             ///< The first unit of a pair; 0 if there is none.
  bool at_begin_ = true;
};

}  // namespace swiftlet::common
