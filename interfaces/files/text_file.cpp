#include "interfaces/files/text_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "common/text_parts.hpp"

namespace swiftlet::interfaces {

std::vector<Word> wordsOf(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r";
  std::vector<Word> words;
  for (std::size_t begin = line.find_first_not_of(kBlank); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlank, begin), line.size());
    words.push_back({line.substr(begin, end - begin), static_cast<int>(begin) + 1});
    begin = line.find_first_not_of(kBlank, end);
  }
  return words;
}

bool saysAtStart(const std::filesystem::path& file, std::string_view text, std::size_t within_bytes) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure)) return false;  // Opening a pipe would block.
  std::string begin(within_bytes, '\0');
  std::ifstream(file).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin.find(text) != std::string::npos;
}

bool parseNumber(std::string_view word, double& value) {
  word = common::withoutPlus(word);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

std::string decimalCommaHint(std::string_view word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos) return "";
  std::string with_point(word);
  with_point[comma] = '.';
  double value = 0.0;
  return parseNumber(with_point, value) ? "write decimals with a point, for instance by `tr , . < FILE`" : "";
}

std::optional<common::Time> parseStamp(std::string_view word) {
  double seconds = 0;
  if (!parseNumber(word, seconds) || std::abs(seconds) > common::kFarthestStamp_s) return std::nullopt;
  const std::size_t dot = word.find('.');
  const std::string_view fraction = dot == std::string_view::npos ? "" : word.substr(dot + 1);
  const bool plain = word.find_first_not_of("0123456789.") == std::string_view::npos && dot != 0;
  if (!plain || fraction.size() > 9) return common::Time::fromSeconds(seconds);
  std::int64_t whole = 0, part = 0;
  const std::string padded = std::string(fraction) + std::string(9 - fraction.size(), '0');
  std::from_chars(word.data(), word.data() + std::min(dot, word.size()), whole);
  std::from_chars(padded.data(), padded.data() + padded.size(), part);
  return common::Time::fromNanoseconds(whole * 1'000'000'000 + part);
}

std::string stampText(common::Time stamp) {
  const std::int64_t ns = stamp.nanoseconds(), magnitude = ns < 0 ? -ns : ns;
  return fmt::format("{}{}.{:09}", ns < 0 ? "-" : "", magnitude / 1'000'000'000, magnitude % 1'000'000'000);
}

}  // namespace swiftlet::interfaces
