#include "interfaces/files/unpacked_stream.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include "common/error.hpp"
#include "common/read_bytes.hpp"

namespace swiftlet::interfaces {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 16;

}  // namespace

/// What the archive library takes its bytes from when they are in no file.
struct UnpackedStream::Feed {
  ByteSource source;
  std::array<char, kBlockBytes> block;

  static la_ssize_t next(struct archive* archive, void* data, const void** bytes) {
    auto& self = *static_cast<Feed*>(data);
    const BytesRead count = self.source(self.block.data(), self.block.size());
    *bytes = self.block.data();
    if (count) return static_cast<la_ssize_t>(*count);
    archive_set_error(archive, EIO, "%s", count.error().c_str());
    return -1;
  }
};

void UnpackedStream::ArchiveDeleter::operator()(struct archive* opened) const { archive_read_free(opened); }

UnpackedStream::UnpackedStream(std::string name) : name_(std::move(name)), archive_(archive_read_new()) {
  archive_read_support_filter_gzip(archive_.get());
  archive_read_support_filter_bzip2(archive_.get());
  archive_read_support_filter_xz(archive_.get());
  archive_read_support_format_raw(archive_.get());
  archive_read_support_format_empty(archive_.get());
}

UnpackedStream::UnpackedStream(const std::filesystem::path& file) : UnpackedStream(file.string()) {
  common::requireFile(file);
  begin(archive_read_open_filename(archive_.get(), file.c_str(), kBlockBytes));
}

UnpackedStream UnpackedStream::fromBytes(std::string_view bytes, std::string name) {
  UnpackedStream stream(std::move(name));
  stream.begin(archive_read_open_memory(stream.archive_.get(), bytes.data(), bytes.size()));
  return stream;
}

UnpackedStream UnpackedStream::fromSource(ByteSource source, std::string name) {
  UnpackedStream stream(std::move(name));
  stream.feed_ = std::make_unique<Feed>();
  stream.feed_->source = std::move(source);
  archive_read_support_filter_lz4(stream.archive_.get());
  stream.begin(archive_read_open(stream.archive_.get(), stream.feed_.get(), nullptr, &Feed::next, nullptr));
  return stream;
}

UnpackedStream::~UnpackedStream() = default;
UnpackedStream::UnpackedStream(UnpackedStream&&) noexcept = default;
UnpackedStream& UnpackedStream::operator=(UnpackedStream&&) noexcept = default;

void UnpackedStream::begin(int open_result) {
  const int error_number = archive_errno(archive_.get());
  if (open_result != ARCHIVE_OK && error_number > 0 && !feed_)
    throw common::InputError(
        common::Problem{{name_}, "", fmt::format("cannot be opened: {}", std::strerror(error_number)), ""});
  struct archive_entry* entry = nullptr;
  const int result = open_result == ARCHIVE_OK ? archive_read_next_header(archive_.get(), &entry) : open_result;
  at_end_ = result == ARCHIVE_EOF;
  if (result != ARCHIVE_OK && !at_end_) failure_ = archiveError();
}

BytesRead UnpackedStream::read(char* to, std::size_t bytes) {
  if (!failure_.empty()) return tl::unexpected(failure_);
  if (at_end_ || bytes == 0) return 0;
  const la_ssize_t count = archive_read_data(archive_.get(), to, bytes);
  if (count < 0) return tl::unexpected(failure_ = archiveError());
  at_end_ = count == 0;
  return static_cast<std::size_t>(count);
}

std::string UnpackedStream::archiveError() const {
  const char* text = archive_error_string(archive_.get());
  return text == nullptr ? "damaged" : text;
}

std::int64_t UnpackedStream::packedBytesRead() const { return archive_filter_bytes(archive_.get(), -1); }

}  // namespace swiftlet::interfaces
