#include "common/read_bytes.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"

namespace swiftlet::common {
namespace {

Problem problemWith(const std::filesystem::path& file, std::string message, std::string hint = "") {
  return {{file.string()}, "", std::move(message), std::move(hint)};
}

/// What a clone has in place of a large file, until that is brought: a small text that says where it is.
struct Pointer {
  std::string_view begins_with;
  const char* keeper;
  const char* remedy;
};
constexpr std::array kPointers{
    Pointer{"version https://git-lfs.github.com/spec/", "Git LFS", "run `git lfs pull` in its repository"},
    Pointer{"version https://hawser.github.com/spec/", "Git LFS", "run `git lfs pull` in its repository"},
    Pointer{"/annex/objects/", "git-annex", "run `git annex get` for it in its repository"},
};

std::optional<Problem> pointerInsteadOf(const std::filesystem::path& file) {
  std::array<char, 64> first{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(first.data(), first.size());
  const std::string_view text(first.data(), static_cast<std::size_t>(stream.gcount()));
  for (const Pointer& pointer : kPointers)
    if (text.starts_with(pointer.begins_with))
      return problemWith(file, fmt::format("this is a pointer of {}, not the file", pointer.keeper), pointer.remedy);
  return std::nullopt;
}

}  // namespace

std::optional<Problem> problemOfFile(const std::filesystem::path& file) {
  std::error_code failure;
  const auto status = std::filesystem::status(file, failure);
  if (std::filesystem::is_directory(status)) return problemWith(file, "is a folder, a file was expected");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return problemWith(file, "is a pipe or a device, a file was expected");
  return std::filesystem::is_regular_file(status) ? pointerInsteadOf(file) : std::nullopt;
}

void requireFile(const std::filesystem::path& file) {
  if (auto problem = problemOfFile(file)) throw InputError(*std::move(problem));
}

std::string readBytes(const std::filesystem::path& file, std::size_t most_bytes) {
  requireFile(file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(problemWith(file, fmt::format("cannot be opened: {}", std::strerror(errno))));

  // Block by block, because files in /proc report a size of 0 and may hold any number of bytes.
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  std::string bytes;
  while (stream && bytes.size() <= most_bytes) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kBlock);
    stream.read(bytes.data() + before, kBlock);
    bytes.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw InputError(problemWith(file, "cannot be read"));
  if (bytes.size() > most_bytes)
    throw InputError(problemWith(file, fmt::format("is larger than {} bytes", most_bytes)));
  return bytes;
}

}  // namespace swiftlet::common
