#include "common/misleading.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

#include <fmt/format.h>

namespace swiftlet::common {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
};

/// Bytes that are no UTF-8 count as themselves.
Character characterAt(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto first = byte(at);
  const std::size_t bytes = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : first >= 0xC2U ? 2 : 1;
  if (bytes == 1 || at + bytes > text.size()) return {first < 0x80U ? first : 0xFFFFFFFFU, 1};
  std::uint32_t code = first & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) return {0xFFFFFFFFU, 1};
    code = code << 6U | (byte(at + i) & 0x3FU);
  }
  return {code, bytes};
}

/// Characters from `first` to `last`, and what is meant by them; empty for characters to be removed.
struct Range {
  std::uint32_t first, last;
  const char* meant;
};
constexpr std::array kRanges = std::to_array<Range>(
    {{0x0000, 0x0008, ""},    {0x000B, 0x000C, ""},   {0x000E, 0x001F, ""},   {0x007F, 0x009F, ""},
     {0x00A0, 0x00A0, " "},   {0x00AB, 0x00AB, "\""}, {0x00AC, 0x00AC, "!"},  {0x00AD, 0x00AD, ""},
     {0x00B4, 0x00B4, "'"},   {0x00B7, 0x00B7, "*"},  {0x00BB, 0x00BB, "\""}, {0x00D7, 0x00D7, "*"},
     {0x00F7, 0x00F7, "/"},   {0x02B9, 0x02BC, "'"},  {0x034F, 0x034F, ""},   {0x037E, 0x037E, ";"},
     {0x061C, 0x061C, ""},    {0x066B, 0x066B, "."},  {0x115F, 0x1160, ""},   {0x1680, 0x1680, " "},
     {0x180E, 0x180E, ""},    {0x2000, 0x200A, " "},  {0x200B, 0x200F, ""},   {0x2010, 0x2015, "-"},
     {0x2018, 0x201B, "'"},   {0x201C, 0x201F, "\""}, {0x2024, 0x2024, "."},  {0x2025, 0x2025, ".."},
     {0x2026, 0x2026, "..."}, {0x2028, 0x2029, "\n"}, {0x202A, 0x202E, ""},   {0x202F, 0x202F, " "},
     {0x2032, 0x2032, "'"},   {0x2033, 0x2033, "\""}, {0x2039, 0x2039, "<"},  {0x203A, 0x203A, ">"},
     {0x2043, 0x2043, "-"},   {0x2044, 0x2044, "/"},  {0x205F, 0x205F, " "},  {0x2060, 0x2064, ""},
     {0x2066, 0x206F, ""},    {0x2212, 0x2212, "-"},  {0x2215, 0x2215, "/"},  {0x2217, 0x2217, "*"},
     {0x2223, 0x2223, "|"},   {0x2227, 0x2227, "&&"}, {0x2228, 0x2228, "||"}, {0x2236, 0x2236, ":"},
     {0x223C, 0x223C, "~"},   {0x2260, 0x2260, "!="}, {0x2264, 0x2264, "<="}, {0x2265, 0x2265, ">="},
     {0x22C5, 0x22C5, "*"},   {0x2796, 0x2796, "-"},  {0x3000, 0x3000, " "},  {0x3001, 0x3001, ","},
     {0x3002, 0x3002, "."},   {0x3164, 0x3164, ""},   {0xFE00, 0xFE0F, ""},   {0xFE63, 0xFE63, "-"},
     {0xFEFF, 0xFEFF, ""},    {0xFFA0, 0xFFA0, ""},   {0xFFF9, 0xFFFD, ""},   {0xE0000, 0xE007F, ""},
     {0xE0100, 0xE01EF, ""}});

/// Full-width forms: each stands this far behind the character of ASCII that it looks like.
constexpr std::uint32_t kFirstFullWidth = 0xFF01, kLastFullWidth = 0xFF5E, kFullWidthShift = 0xFEE0;

/// The name of a frequent one; others have none.
const char* nameOf(std::uint32_t code) {
  switch (code) {
    case 0x00A0:
      return "a no-break space";
    case 0x00AD:
      return "a soft hyphen";
    case 0x200B:
      return "a zero-width space";
    case 0x2013:
      return "an en dash";
    case 0x2212:
      return "a minus sign";
    case 0x2028:
      return "a line separator";
    case 0xFEFF:
      return "a byte order mark";
    default:
      return nullptr;
  }
}

std::string insteadOf(const std::string& meant) {
  if (meant == " ") return "a plain blank";
  if (meant == "\n") return "a new line";
  if (meant == "-") return "a plain minus";
  return meant.empty() ? "nothing there" : fmt::format("`{}`", meant);
}

/// What is meant by a character that misleads.
std::optional<std::string> meantBy(std::uint32_t code) {
  const auto* range = std::find_if(kRanges.begin(), kRanges.end(),
                                   [&](const Range& one) { return code >= one.first && code <= one.last; });
  if (range != kRanges.end()) return range->meant;
  if (code < kFirstFullWidth || code > kLastFullWidth) return std::nullopt;
  return std::string(1, static_cast<char>(code - kFullWidthShift));
}

std::optional<Misleading> judged(std::uint32_t code, std::size_t offset) {
  const auto meant = meantBy(code);
  if (!meant) return std::nullopt;
  const char* kind = "an invisible character";
  if (*meant == " ") kind = "a blank of another kind";
  if (code < 0xA0) kind = "a control character";
  const char* name = nameOf(code);
  const std::string what = name != nullptr                   ? name
                           : meant->empty() || *meant == " " ? kind
                                                             : fmt::format("a character that looks like `{}`", *meant);
  return Misleading{offset, fmt::format("{} (U+{:04X})", what, code), insteadOf(*meant)};
}

bool isLetter(std::string_view text, std::size_t at) {
  return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])) != 0;
}

}  // namespace

std::optional<Misleading> misleadingIn(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto [code, bytes] = characterAt(text, at);
    if (auto found = judged(code, at)) return found;
    const bool greek = code >= 0x0370 && code <= 0x03FF, cyrillic = code >= 0x0400 && code <= 0x052F;
    if ((greek || cyrillic) && ((at > 0 && isLetter(text, at - 1)) || isLetter(text, at + bytes)))
      return Misleading{at, fmt::format("a {} letter (U+{:04X})", greek ? "Greek" : "Cyrillic", code), "the Latin one"};
    at += bytes;
  }
  return std::nullopt;
}

std::string misleadingHint(std::string_view text) {
  const auto found = misleadingIn(text);
  return found ? fmt::format("it has {}: write {}", found->what, found->instead) : "";
}

std::string asSeen(std::string_view text) {
  std::string seen;
  for (std::size_t at = 0; at < text.size();) {
    const auto [code, bytes] = characterAt(text, at);
    const auto meant = meantBy(code);
    seen += meant ? std::string_view(*meant) : text.substr(at, bytes);
    at += bytes;
  }
  return seen;
}

}  // namespace swiftlet::common
