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

Problem problemWith(const std::filesystem::path& file, Message message, std::string hint = "") {
  return {{file.string()}, "", std::move(message), std::move(hint)};
}

/// The pointer that a clone has in place of a large file, until that is fetched: a small text with its location.
struct Pointer {
  std::string_view begins_with;
  const char* keeper;
  const char* remedy;
};
constexpr const char* kAnnexRemedy = "run `git annex get` for it in its repository";
constexpr std::array kPointers{
    Pointer{"version https://git-lfs.github.com/spec/", "Git LFS", "run `git lfs pull` in its repository"},
    Pointer{"version https://hawser.github.com/spec/", "Git LFS", "run `git lfs pull` in its repository"},
    Pointer{"/annex/objects/", "git-annex", kAnnexRemedy},
};

/// Where a link of git-annex leads. Systems without links have the same as a text.
bool leadsIntoAnnex(std::string_view target) {
  while (target.starts_with("../")) target.remove_prefix(3);
  const std::string_view folder = target.substr(0, target.find("/annex/objects/"));
  return folder.size() < target.size() && (folder == ".git" || folder.starts_with(".git/modules/")) &&
         folder.find('\n') == std::string_view::npos;
}

/// How packed files begin.
struct Packer {
  std::string_view begins_with;
  const char* name;
  const char* remedy;
};
constexpr std::array kPackers{Packer{"\x1f\x8b", "gzip", "gunzip"}, Packer{"BZh", "bzip2", "bunzip2"},
                              Packer{"\xfd"
                                     "7zXZ",
                                     "xz", "unxz"},
                              Packer{"\x28\xb5\x2f\xfd", "zstd", "unzstd"}, Packer{"PK\x03\x04", "zip", "unzip"}};

Problem pointerProblem(const std::filesystem::path& file, const char* keeper, const char* remedy) {
  return problemWith(file, Message("file.pointer", "this is a pointer of {}, not the file", keeper), remedy);
}

std::optional<Problem> pointerInsteadOf(const std::filesystem::path& file) {
  std::array<char, 256> first{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(first.data(), first.size());
  return problemOfPointer(file, {first.data(), static_cast<std::size_t>(stream.gcount())});
}

}  // namespace

std::optional<Problem> problemOfLink(const std::filesystem::path& file) {
  std::error_code failure;
  const std::filesystem::path target = std::filesystem::read_symlink(file, failure);
  if (failure || std::filesystem::exists(file, failure) || failure) return std::nullopt;
  return problemWith(file, Message("file.broken-link", "is a link that leads to nothing: `{}`", target.string()),
                     target.generic_string().find("/annex/objects/") == std::string::npos ? "" : kAnnexRemedy);
}

std::optional<Problem> problemOfPointer(const std::filesystem::path& file, std::string_view beginning) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // Some editors put it before a text.
  if (beginning.starts_with(kByteOrderMark)) beginning.remove_prefix(kByteOrderMark.size());
  for (const Pointer& pointer : kPointers)
    if (beginning.starts_with(pointer.begins_with)) return pointerProblem(file, pointer.keeper, pointer.remedy);
  if (leadsIntoAnnex(beginning)) return pointerProblem(file, "git-annex", kAnnexRemedy);
  return std::nullopt;
}

std::optional<Problem> problemOfFile(const std::filesystem::path& file) {
  if (auto problem = problemOfLink(file)) return problem;
  std::error_code failure;
  const auto status = std::filesystem::status(file, failure);
  if (std::filesystem::is_directory(status))
    return problemWith(file, Message("file.is-folder", "is a folder, a file was expected"));
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return problemWith(file, Message("file.is-pipe", "is a pipe or a device, a file was expected"));
  return std::filesystem::is_regular_file(status) ? pointerInsteadOf(file) : std::nullopt;
}

void requireFile(const std::filesystem::path& file) {
  if (auto problem = problemOfFile(file)) throw InputError(*std::move(problem));
}

std::string readBytes(const std::filesystem::path& file, std::size_t most_bytes) {
  requireFile(file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw InputError(problemWith(file, Message("file.not-opened", "cannot be opened: {}", std::strerror(errno))));

  // Block by block, because files in /proc report a size of 0 and may hold any number of bytes.
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  std::string bytes;
  while (stream && bytes.size() <= most_bytes) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kBlock);
    stream.read(bytes.data() + before, kBlock);
    bytes.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw InputError(problemWith(file, Message("file.not-read", "cannot be read")));
  if (bytes.size() > most_bytes)
    throw InputError(problemWith(file, Message("file.too-large", "is larger than {} bytes", most_bytes)));
  return bytes;
}

std::string readText(const std::filesystem::path& file, std::size_t most_bytes) {
  std::string text = readBytes(file, most_bytes);
  for (const Packer& packer : kPackers)
    if (text.starts_with(packer.begins_with))
      throw InputError(problemWith(file, Message("file.packed", "is packed by {}, a text was expected", packer.name),
                                   fmt::format("unpack it by `{}`", packer.remedy)));
  return text;
}

}  // namespace swiftlet::common
