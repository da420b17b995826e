#include "common/number_list.hpp"

#include <algorithm>
#include <charconv>

#include "common/text_parts.hpp"

namespace swiftlet::common {
namespace {

constexpr std::string_view kSpaces = " \t\r\n";

/// The second part of `10 000` is not a number of its own.
bool isWrittenNumber(std::string_view text) {
  if (text.size() > 1 && text.starts_with('0') && text[1] != '.') return false;
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}

/// Where commas do not separate, they are the decimal points of some countries. Empty if an item is no number.
std::string splitAt(std::string_view text, std::string_view separators) {
  std::string list;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    std::string item(withoutPlus(trimmed(text.substr(begin, end - begin), kSpaces)));
    begin = end + 1;
    if (separators == kSpaces && item.empty()) continue;
    if (separators == kSpaces && item.ends_with(',')) item.pop_back();
    std::replace(item.begin(), item.end(), ',', '.');
    if (!isWrittenNumber(item)) return "";
    list += (list.empty() ? "[" : ", ") + item;
  }
  return list.empty() ? "" : list + "]";
}

}  // namespace

std::string numberListOf(std::string_view written) {
  const std::string_view text = trimmed(written, " \t\r\n()[]{}");
  for (const std::string_view separators : {std::string_view(";"), std::string_view(","), kSpaces})
    if (std::string list = splitAt(text, separators); !list.empty()) return list;
  return "";
}

std::string numberListHint(std::string_view written) {
  const std::string list = numberListOf(written);
  return list.empty() ? "write the numbers in brackets, with commas between them" : "write `" + list + "`";
}

}  // namespace swiftlet::common
