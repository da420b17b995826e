// Parts of a text that its readers leave out.
#pragma once

#include <algorithm>
#include <string_view>

namespace swiftlet::common {

/// The text without the marks at its two ends.
inline std::string_view trimmed(std::string_view text, std::string_view marks = " \t\r\n") {
  const std::size_t begin = std::min(text.find_first_not_of(marks), text.size());
  return text.substr(begin, text.find_last_not_of(marks) + 1 - begin);
}

/// A number without the plus before it, which std::from_chars() does not take. That of `+-1`, which is not a number,
/// stays.
inline std::string_view withoutPlus(std::string_view word) {
  return word.starts_with('+') && !word.starts_with("+-") ? word.substr(1) : word;
}

}  // namespace swiftlet::common
