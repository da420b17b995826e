// Reads whole files, for every reader of input.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "common/error.hpp"

namespace swiftlet::common {

/// What is wrong with a link that leads to nothing; everything else passes.
std::optional<Problem> problemOfLink(const std::filesystem::path& file);
/// What is wrong with a folder, a pipe or a device, or with a pointer of Git LFS or git-annex that stands for the file
/// in a clone: a small text, or a link that leads to nothing. A pipe or a device could block a reader forever. What
/// cannot be opened otherwise passes.
std::optional<Problem> problemOfFile(const std::filesystem::path& file);

/// What is wrong with a file that begins so, if that is such a text.
std::optional<Problem> problemOfPointer(const std::filesystem::path& file, std::string_view beginning);

/// Throws InputError where problemOfFile() has one.
void requireFile(const std::filesystem::path& file);

/// The default limit for the size of a file that is read into memory.
inline constexpr std::size_t kMostFileBytes = std::size_t{1} << 30;

/// The bytes of a file. Throws InputError if it is not a regular file, cannot be read, or is larger than `most_bytes`.
std::string readBytes(const std::filesystem::path& file, std::size_t most_bytes = kMostFileBytes);

/// The same for texts that are not unpacked. Throws InputError also if the file is packed, by gzip for instance.
std::string readText(const std::filesystem::path& file, std::size_t most_bytes = kMostFileBytes);

}  // namespace swiftlet::common
