// Words and numbers of text files, for the readers in this folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/time.hpp"

namespace swiftlet::interfaces {

/// A word of a line with its first column, counted from 1.
struct Word {
  std::string_view text;
  int column = 0;
};

/// The words of a line, separated by spaces and tabs; views into `line`.
std::vector<Word> wordsOf(std::string_view line);

/// True for a regular file with `text` within its first bytes. Files that Swiftlet wrote are recognized so.
bool saysAtStart(const std::filesystem::path& file, std::string_view text, std::size_t within_bytes);

/// No robot moves farther than this from the origin of a file. A larger coordinate is an error, and would exceed the
/// precision of the figures computed from it.
inline constexpr double kFarthest_m = 1e8;

/// The whole word as a finite number; false if it is anything else.
bool parseNumber(std::string_view word, double& value);

/// What to do where a decimal comma keeps the word from being a number; empty for anything else.
std::string decimalCommaHint(std::string_view word);

/// Seconds, exact for plain decimals; a double of seconds since 1970 would not be exact. nullopt for anything else.
std::optional<common::Time> parseStamp(std::string_view word);
/// Seconds with nine decimals, computed from the nanoseconds, so that they read back exactly.
std::string stampText(common::Time stamp);

}  // namespace swiftlet::interfaces
