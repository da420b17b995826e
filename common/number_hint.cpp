#include "common/number_hint.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>

#include <fmt/format.h>

#include "common/misleading.hpp"
#include "common/text_parts.hpp"

namespace swiftlet::common {
namespace {

/// "m_s" of "m/s" and "m_s", "deg" of "°".
std::string unitOf(std::string_view written) {
  std::string unit;
  for (std::size_t i = 0; i < written.size(); ++i) {
    const std::string_view rest = written.substr(i);
    if (rest.starts_with("\xC2\xB0") || rest.starts_with("\xC2\xB2")) {
      unit += rest.starts_with("\xC2\xB0") ? "deg" : "2";
      ++i;
    } else if (rest.starts_with("\xB0")) {  // In Latin-1.
      unit += "deg";
    } else if (written[i] != '^') {
      unit += written[i] == '/' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(written[i])));
    }
  }
  return unit;
}

}  // namespace

std::string numberHint(std::string_view key, std::string_view written, bool whole) {
  if (std::string hint = misleadingHint(written); !hint.empty()) return hint;
  const std::string_view text = trimmed(written);
  std::size_t end = 0;
  std::string number;
  int marks = 0;
  for (; end < text.size(); ++end) {
    const char c = text[end];
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    const bool digit_next = end + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[end + 1])) != 0;
    const bool sign = end == 0 && (c == '-' || c == '+');
    if (c == ',' || c == '.') ++marks;
    if (digit || sign)
      number += c;
    else if (c == ',' || c == '.')
      number += '.';
    else if (!(end > 0 && digit_next && (c == ' ' || c == '_' || c == '\'')))
      break;
  }
  if (number.find_first_of("0123456789") == std::string::npos) return "";
  // "1,081" may be a thousand or one; "0,081" is one.
  const std::size_t comma = text.find(',');
  const bool ambiguous = comma != std::string_view::npos && end == comma + 4 && text.find_first_of("123456789") < comma;
  if (!whole && (marks > 1 || ambiguous)) return "write decimals with a point, and no other marks";
  if (whole && marks > 0)
    return comma == std::string_view::npos ? "" : "write a whole number, without points or commas";
  const std::string_view rest = trimmed(text.substr(end));
  if (rest.empty()) return number == text ? "" : fmt::format("write `{}`", number);
  if (rest.starts_with('#')) return fmt::format("put a blank before the comment: `{} {}`", number, rest);
  if (rest.find_first_of("]}") == 0) return fmt::format("leave out the `{}`: no bracket is open there", rest[0]);
  constexpr std::array<std::string_view, 12> kUnits{"m",  "s", "s2", "deg", "rad", "hz",
                                                    "kg", "v", "n",  "ah",  "px",  "m2"};
  const bool has_unit = std::find(kUnits.begin(), kUnits.end(), key.substr(key.rfind('_') + 1)) != kUnits.end();
  if (rest == "%" && !has_unit)
    return fmt::format("write `{}`: shares are of 1", std::strtod(number.c_str(), nullptr) / 100.0);
  const std::string unit = unitOf(rest);
  if (key.ends_with("_" + unit)) return fmt::format("write `{}`: the key's name has the unit", number);
  if (has_unit) return "write the number alone, in the unit that the key's name ends with";
  const bool has_exponent = std::tolower(static_cast<unsigned char>(rest[0])) == 'e' && rest.size() > 1;
  if (has_exponent) return "";
  return key.empty() ? "write the number alone, in the unit that --help names"
                     : "write the number alone, in the unit in which it is described";
}

}  // namespace swiftlet::common
