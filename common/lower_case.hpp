// Words and endings of files that tools write in either case.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

namespace swiftlet::common {

/// The letters A to Z as small ones; all other bytes stay.
inline std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

/// ".ply" of "room.PLY".
inline std::string endingOf(const std::filesystem::path& file) { return lowerCase(file.extension().string()); }

}  // namespace swiftlet::common
