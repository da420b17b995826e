#include "behaviors/tree/characters.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "behaviors/tree/utf8.hpp"

namespace swiftlet::tree {
namespace {

/// Characters from `first` to `last`, as Unicode names them, and what is meant by them; empty for characters to be
/// removed.
struct Range {
  std::uint32_t first = 0, last = 0;
  std::string_view name, meant;
};

// Sorted. The format controls of Unicode (Cf), its blanks (Z), and what is typed or pasted in the place of ASCII.
constexpr std::array kMisleading = {Range{0x0080, 0x0084, "control character", ""},
                                    Range{0x0085, 0x0085, "next line", ""},
                                    Range{0x0086, 0x009F, "control character", ""},
                                    Range{0x00A0, 0x00A0, "no-break space", " "},
                                    Range{0x00AB, 0x00AB, "left-pointing double angle quotation mark", "\""},
                                    Range{0x00AC, 0x00AC, "not sign", "!"},
                                    Range{0x00AD, 0x00AD, "soft hyphen", ""},
                                    Range{0x00B4, 0x00B4, "acute accent", "'"},
                                    Range{0x00B7, 0x00B7, "middle dot", "*"},
                                    Range{0x00BB, 0x00BB, "right-pointing double angle quotation mark", "\""},
                                    Range{0x00D7, 0x00D7, "multiplication sign", "*"},
                                    Range{0x00F7, 0x00F7, "division sign", "/"},
                                    Range{0x02B9, 0x02BC, "modifier letter apostrophe", "'"},
                                    Range{0x034F, 0x034F, "combining grapheme joiner", ""},
                                    Range{0x037E, 0x037E, "Greek question mark", ";"},
                                    Range{0x061C, 0x061C, "Arabic letter mark", ""},
                                    Range{0x066B, 0x066B, "Arabic decimal separator", "."},
                                    Range{0x115F, 0x1160, "Hangul filler", ""},
                                    Range{0x1680, 0x1680, "Ogham space mark", " "},
                                    Range{0x180E, 0x180E, "Mongolian vowel separator", ""},
                                    Range{0x2000, 0x2006, "a space of another width", " "},
                                    Range{0x2007, 0x2007, "figure space", " "},
                                    Range{0x2008, 0x2008, "punctuation space", " "},
                                    Range{0x2009, 0x2009, "thin space", " "},
                                    Range{0x200A, 0x200A, "hair space", " "},
                                    Range{0x200B, 0x200B, "zero width space", ""},
                                    Range{0x200C, 0x200C, "zero width non-joiner", ""},
                                    Range{0x200D, 0x200D, "zero width joiner", ""},
                                    Range{0x200E, 0x200E, "left-to-right mark", ""},
                                    Range{0x200F, 0x200F, "right-to-left mark", ""},
                                    Range{0x2010, 0x2010, "hyphen", "-"},
                                    Range{0x2011, 0x2011, "non-breaking hyphen", "-"},
                                    Range{0x2012, 0x2012, "figure dash", "-"},
                                    Range{0x2013, 0x2013, "en dash", "-"},
                                    Range{0x2014, 0x2014, "em dash", "-"},
                                    Range{0x2015, 0x2015, "horizontal bar", "-"},
                                    Range{0x2018, 0x2018, "left single quotation mark", "'"},
                                    Range{0x2019, 0x2019, "right single quotation mark", "'"},
                                    Range{0x201A, 0x201A, "single low-9 quotation mark", "'"},
                                    Range{0x201B, 0x201B, "single high-reversed-9 quotation mark", "'"},
                                    Range{0x201C, 0x201C, "left double quotation mark", "\""},
                                    Range{0x201D, 0x201D, "right double quotation mark", "\""},
                                    Range{0x201E, 0x201E, "double low-9 quotation mark", "\""},
                                    Range{0x201F, 0x201F, "double high-reversed-9 quotation mark", "\""},
                                    Range{0x2024, 0x2024, "one dot leader", "."},
                                    Range{0x2025, 0x2025, "two dot leader", ".."},
                                    Range{0x2026, 0x2026, "horizontal ellipsis", "..."},
                                    Range{0x2028, 0x2028, "line separator", " "},
                                    Range{0x2029, 0x2029, "paragraph separator", " "},
                                    Range{0x202A, 0x202E, "direction control", ""},
                                    Range{0x202F, 0x202F, "narrow no-break space", " "},
                                    Range{0x2032, 0x2032, "prime", "'"},
                                    Range{0x2033, 0x2033, "double prime", "\""},
                                    Range{0x2039, 0x2039, "single left-pointing angle quotation mark", "<"},
                                    Range{0x203A, 0x203A, "single right-pointing angle quotation mark", ">"},
                                    Range{0x2043, 0x2043, "hyphen bullet", "-"},
                                    Range{0x2044, 0x2044, "fraction slash", "/"},
                                    Range{0x205F, 0x205F, "medium mathematical space", " "},
                                    Range{0x2060, 0x2060, "word joiner", ""},
                                    Range{0x2061, 0x2064, "invisible operator", ""},
                                    Range{0x2066, 0x206F, "direction control", ""},
                                    Range{0x2212, 0x2212, "minus sign", "-"},
                                    Range{0x2215, 0x2215, "division slash", "/"},
                                    Range{0x2217, 0x2217, "asterisk operator", "*"},
                                    Range{0x2223, 0x2223, "divides", "|"},
                                    Range{0x2227, 0x2227, "logical and", "&&"},
                                    Range{0x2228, 0x2228, "logical or", "||"},
                                    Range{0x2236, 0x2236, "ratio", ":"},
                                    Range{0x223C, 0x223C, "tilde operator", "~"},
                                    Range{0x2260, 0x2260, "not equal to", "!="},
                                    Range{0x2264, 0x2264, "less-than or equal to", "<="},
                                    Range{0x2265, 0x2265, "greater-than or equal to", ">="},
                                    Range{0x22C5, 0x22C5, "dot operator", "*"},
                                    Range{0x2796, 0x2796, "heavy minus sign", "-"},
                                    Range{0x3000, 0x3000, "ideographic space", " "},
                                    Range{0x3001, 0x3001, "ideographic comma", ","},
                                    Range{0x3002, 0x3002, "ideographic full stop", "."},
                                    Range{0x3164, 0x3164, "Hangul filler", ""},
                                    Range{0xFE00, 0xFE0F, "variation selector", ""},
                                    Range{0xFE63, 0xFE63, "small hyphen-minus", "-"},
                                    Range{0xFEFF, 0xFEFF, "byte order mark", ""},
                                    Range{0xFFA0, 0xFFA0, "halfwidth Hangul filler", ""},
                                    Range{0xFFF9, 0xFFFB, "interlinear annotation", ""},
                                    Range{0xFFFC, 0xFFFC, "object replacement character", ""},
                                    Range{0xFFFD, 0xFFFD, "replacement character", ""},
                                    Range{0xE0000, 0xE007F, "tag", ""},
                                    Range{0xE0100, 0xE01EF, "variation selector", ""}};

/// Full-width forms: each stands this far behind the character of ASCII that it looks like.
constexpr std::uint32_t kFirstFullWidth = 0xFF01, kLastFullWidth = 0xFF5E, kFullWidthShift = 0xFEE0;

/// Of a character that is there.
std::uint32_t codePointAt(std::string_view text, std::size_t offset) {
  const std::size_t length = characterLength(text, offset);
  const auto first = static_cast<unsigned char>(text[offset]);
  if (length < 2) return first;
  std::uint32_t code = first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) code = code << 6U | (static_cast<unsigned char>(text[offset + i]) & 0x3FU);
  return code;
}

bool isAsciiLetter(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) return false;
  const char low = static_cast<char>(text[offset] | 0x20);
  return low >= 'a' && low <= 'z';
}

/// A letter of Greek or Cyrillic, many of which look like Latin ones.
const char* scriptOf(std::uint32_t code) {
  if (code >= 0x0370 && code <= 0x03FF && code != 0x037E) return "a Greek letter";
  return code >= 0x0400 && code <= 0x052F ? "a Cyrillic letter" : nullptr;
}

/// A character's name and what is meant by it, as in Range.
struct Meaning {
  std::string name, meant;
};

/// Without a name for a character that is not misleading.
Meaning lookUp(std::uint32_t code) {
  std::string name, meant;
  const auto* found = std::find_if(kMisleading.begin(), kMisleading.end(),
                                   [&](const Range& range) { return code >= range.first && code <= range.last; });
  if (found != kMisleading.end()) {
    name = found->name;
    meant = found->meant;
  } else if (code >= kFirstFullWidth && code <= kLastFullWidth) {
    name = "full-width form";
    meant = static_cast<char>(code - kFullWidthShift);
  } else if (code < 0x20 || code == 0x7F) {
    name = "control character";
  }
  return {std::move(name), std::move(meant)};
}

/// "zero width space, take it out" or "minus sign, write `-`"; empty for a character that is not misleading.
std::string meaningOf(std::uint32_t code) {
  const auto [name, meant] = lookUp(code);
  if (name.empty()) return {};
  return name + (meant == " " ? ", write a blank" : meant.empty() ? ", take it out" : ", write `" + meant + "`");
}

std::string named(std::uint32_t code, const std::string& meaning) {
  std::array<char, 16> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "U+%04X", static_cast<unsigned>(code));
  return std::string(buffer.data()) + (meaning.empty() ? "" : " (" + meaning + ")");
}

}  // namespace

std::size_t characterLength(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) return 0;
  const auto first = static_cast<unsigned char>(text[offset]);
  if (first < 0x80U) return 1;
  const std::size_t length = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : 2;
  if (first < 0xC2U || first > 0xF4U || offset + length > text.size()) return 0;
  const std::string_view rest = text.substr(offset + 1, length - 1);
  return std::all_of(rest.begin(), rest.end(), continuesCharacter) ? length : 0;
}

bool isUtf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = characterLength(text, at);
    if (length == 0) return false;
    at += length;
  }
  return true;
}

std::string nameOfCharacter(std::string_view text, std::size_t offset) {
  if (characterLength(text, offset) == 0) return {};
  const std::uint32_t code = codePointAt(text, offset);
  const char* script = scriptOf(code);
  return named(code, script == nullptr ? meaningOf(code) : script);
}

std::string asSeen(std::string_view text) {
  std::string seen;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(characterLength(text, at), 1);
    const Meaning meaning = length > 1 ? lookUp(codePointAt(text, at)) : Meaning();
    seen += meaning.name.empty() ? text.substr(at, length) : std::string_view(meaning.meant);
    at += length;
  }
  return seen;
}

std::string misleadingCharacterIn(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(characterLength(text, at), 1);
    if (length > 1) {
      const std::uint32_t code = codePointAt(text, at);
      const bool beside_ascii = (at > 0 && isAsciiLetter(text, at - 1)) || isAsciiLetter(text, at + length);
      const char* script = beside_ascii ? scriptOf(code) : nullptr;
      if (script != nullptr) return named(code, script);
      if (std::string meaning = meaningOf(code); !meaning.empty()) return named(code, meaning);
    }
    at += length;
  }
  return {};
}

}  // namespace swiftlet::tree
