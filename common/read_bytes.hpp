// Reads whole files, for every reader of input.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace swiftlet::common {

/// Throws InputError for a folder, a pipe or a device, and for a pointer of Git LFS or git-annex that stands for the
/// file in a clone: a small text, or a link that leads to nothing. A pipe or a device could block a reader forever.
/// What cannot be opened otherwise passes.
void requireFile(const std::filesystem::path& file);

/// Throws InputError for a link that leads to nothing; everything else passes.
void refuseDanglingLink(const std::filesystem::path& file);

/// The default limit for the size of a file that is read into memory.
inline constexpr std::size_t kMostFileBytes = std::size_t{1} << 30;

/// The bytes of a file. Throws InputError if it is not a regular file, cannot be read, or is larger than `most_bytes`.
std::string readBytes(const std::filesystem::path& file, std::size_t most_bytes = kMostFileBytes);

}  // namespace swiftlet::common
