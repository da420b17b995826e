#include "interfaces/files/atomic_file.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace swiftlet::interfaces {
namespace {

FileError errorOf(const std::filesystem::path& file, int error_number) {
  const std::error_code why(error_number, std::generic_category());
  return {common::Message("file.not-written", "{}: {}", file.string(), why.message()), why};
}

/// Creates a file of that name and returns its descriptor as open(2) does. An older file of that name is unlinked
/// first: writing through a link would change a file elsewhere.
int openAnew(const std::filesystem::path& file, int flags) {
  if (::unlink(file.c_str()) != 0 && errno != ENOENT) return -1;
  return ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | flags, 0644);
}

/// 0 or the errno of the write that failed.
int writeAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

/// The entry of the file's name reaches the disk only when its folder is synced.
int syncFolder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  const int failure = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return failure;
}

std::filesystem::path temporaryOf(std::filesystem::path file) {
  file += fmt::format(".{}.part", ::getpid());
  return file;
}

}  // namespace

Written tryToWrite(const std::filesystem::path& file) {
  const std::filesystem::path temporary = temporaryOf(file);
  const int descriptor = openAnew(temporary, 0);
  if (descriptor < 0) return tl::unexpected(errorOf(file, errno));
  ::close(descriptor);
  ::unlink(temporary.c_str());
  return {};
}

Written writeAtomically(const std::filesystem::path& file, std::string_view bytes, Durability durability) {
  return writeAtomically(
      file, [bytes](const WriteBytes& write) { write(bytes); }, durability);
}

Written writeAtomically(const std::filesystem::path& file, const std::function<void(const WriteBytes&)>& content,
                        Durability durability) {
  const std::filesystem::path temporary = temporaryOf(file);
  const int descriptor = openAnew(temporary, 0);
  if (descriptor < 0) return tl::unexpected(errorOf(file, errno));

  int failure = 0;
  content([&](std::string_view bytes) {
    if (failure == 0) failure = writeAll(descriptor, bytes);
  });
  if (failure == 0 && durability == Durability::kPower && ::fsync(descriptor) != 0) failure = errno;
  if (::close(descriptor) != 0 && failure == 0) failure = errno;
  if (failure == 0 && ::rename(temporary.c_str(), file.c_str()) != 0) failure = errno;
  if (failure != 0) {
    ::unlink(temporary.c_str());
    return tl::unexpected(errorOf(file, failure));
  }
  if (durability == Durability::kPower) failure = syncFolder(file.parent_path());
  if (failure != 0) return tl::unexpected(errorOf(file, failure));
  return {};
}

tl::expected<AppendFile, FileError> AppendFile::create(const std::filesystem::path& file) {
  const int descriptor = openAnew(file, O_APPEND);
  if (descriptor < 0) return tl::unexpected(errorOf(file, errno));
  return AppendFile(file, descriptor);
}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

AppendFile& AppendFile::operator=(AppendFile&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  return *this;
}

Written AppendFile::append(std::string_view record) {
  if (const int failure = writeAll(descriptor_, record); failure != 0) {
    // A truncation frees space, so it succeeds where the write failed. If it fails nevertheless, the reader ignores a
    // last line without an end.
    [[maybe_unused]] const int truncated = ::ftruncate(descriptor_, size_);
    return tl::unexpected(errorOf(file_, failure));
  }
  size_ += static_cast<std::int64_t>(record.size());
  return {};
}

}  // namespace swiftlet::interfaces
