#include "interfaces/files/text_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <system_error>

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
  if (!std::filesystem::is_regular_file(file, failure)) return false;  // A pipe would make us wait.
  std::string begin(within_bytes, '\0');
  std::ifstream(file).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin.find(text) != std::string::npos;
}

bool parseNumber(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

}  // namespace swiftlet::interfaces
