// Words and numbers of text files, for the readers beside this.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/time.hpp"

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

/// Nobody drives or flies farther from where a file begins: a coordinate beyond is a mistake, and would take the
/// figures that are made of it out of what numbers hold.
inline constexpr double kFarthest_m = 1e8;

/// The whole word as a finite number; false when it is anything else.
bool parseNumber(std::string_view word, double& value);

/// Seconds; exact for plain decimals, which a double of seconds since 1970 is not. None for anything else.
std::optional<common::Time> parseStamp(std::string_view word);
/// Seconds with nine decimals, from the nanoseconds: it reads back exactly.
std::string stampText(common::Time stamp);

}  // namespace swiftlet::interfaces
