// Words and numbers of text files, for the readers beside this.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

namespace swiftlet::interfaces {

/// A word of a line and the column it starts at, counted from 1.
struct Word {
  std::string_view text;
  int column = 0;
};

/// The words of a line, separated by spaces and tabs; views into `line`.
std::vector<Word> wordsOf(std::string_view line);

/// A regular file that has `text` within its first bytes, by which one knows files of one's own.
bool saysAtStart(const std::filesystem::path& file, std::string_view text, std::size_t within_bytes);

/// The whole word as a finite number; false when it is anything else.
bool parseNumber(std::string_view word, double& value);

}  // namespace swiftlet::interfaces
