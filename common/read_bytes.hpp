// Whole files, for every reader of input.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace swiftlet::common {

/// Throws InputError for a folder, a pipe or a device; the latter two could make a reader wait for ever.
void requireFile(const std::filesystem::path& file);

/// Larger files are not read into memory unless asked for.
inline constexpr std::size_t kMostFileBytes = std::size_t{1} << 30;

/// The bytes of a file. Throws InputError when it is no regular file, cannot be read, or is larger than `most_bytes`.
std::string readBytes(const std::filesystem::path& file, std::size_t most_bytes = kMostFileBytes);

}  // namespace swiftlet::common
