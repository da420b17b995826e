#include "interfaces/files/unpacked_stream.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "common/read_bytes.hpp"
#include "common/utf16.hpp"
#include "interfaces/files/gunzip.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Message;

constexpr std::size_t kUnpackedBytes = std::size_t{1} << 16;
/// Limit of nested packings: a crafted file can unpack to itself forever.
constexpr int kMostGzipLayers = 20;

ByteSource sourceOf(const std::filesystem::path& file) {
  common::requireFile(file);
  std::FILE* opened = std::fopen(file.c_str(), "rb");
  if (opened == nullptr)
    throw common::InputError({file.string()}, "",
                             Message("file.not-opened", "cannot be opened: {}", std::strerror(errno)));
  return [held = std::shared_ptr<std::FILE>(opened, &std::fclose)](char* to, std::size_t bytes) -> BytesRead {
    const std::size_t count = std::fread(to, 1, bytes, held.get());
    if (count == 0 && std::ferror(held.get()) != 0) return tl::unexpected(std::string(std::strerror(errno)));
    return count;
  };
}

ByteSource sourceOf(std::string_view bytes) {
  return [bytes](char* to, std::size_t count) mutable -> BytesRead {
    const std::size_t taken = bytes.copy(to, count);
    bytes.remove_prefix(taken);
    return taken;
  };
}

/// Reads up to `count` bytes; fewer only at the end.
tl::expected<std::string, std::string> firstBytes(const ByteSource& source, std::size_t count) {
  std::string first;
  while (first.size() < count) {
    std::string more(count - first.size(), '\0');
    const BytesRead taken = source(more.data(), more.size());
    if (!taken) return tl::unexpected(taken.error());
    if (*taken == 0) break;
    first += more.substr(0, *taken);
  }
  return first;
}

/// Returns `first`, then the rest of `rest`.
ByteSource joined(std::string first, ByteSource rest) {
  return [first = std::move(first), rest = std::move(rest)](char* to, std::size_t bytes) mutable -> BytesRead {
    if (first.empty()) return rest(to, bytes);
    const std::size_t taken = first.copy(to, bytes);
    first.erase(0, taken);
    return taken;
  };
}

/// The text of `utf16` as UTF-8.
ByteSource utf8From(ByteSource utf16, common::ByteOrder order) {
  return [utf16 = std::move(utf16), decoder = common::Utf16Decoder(order), text = std::string(), at_end = false](
             char* to, std::size_t bytes) mutable -> BytesRead {
    while (text.empty() && !at_end && bytes > 0) {
      std::array<char, 4096> block{};
      const BytesRead count = utf16(block.data(), block.size());
      if (!count) return count;
      at_end = *count == 0;
      decoder.decode({block.data(), *count}, text);
      if (at_end) decoder.finish(text);
    }
    const std::size_t taken = text.copy(to, bytes);
    text.erase(0, taken);
    return taken;
  };
}

/// Unpacks gzip, also if it is packed several times, and makes UTF-8 of UTF-16 where `text_is_likely`; everything else
/// is left unchanged.
tl::expected<ByteSource, std::string> withoutGzip(ByteSource source, bool text_is_likely) {
  for (int layers = 0; layers <= kMostGzipLayers; ++layers) {
    auto first = firstBytes(source, kGzipMagic.size());
    if (!first) return tl::unexpected(first.error());
    const bool packed = *first == kGzipMagic;
    const auto utf16_order = text_is_likely ? common::utf16OrderOf(*first) : std::nullopt;
    source = joined(std::move(*first), std::move(source));
    if (utf16_order) return utf8From(std::move(source), *utf16_order);
    if (!packed) return source;
    source = gunzipped(std::move(source));
  }
  return tl::unexpected(fmt::format("gzip: packed more than {} times", kMostGzipLayers));
}

}  // namespace

/// The source from which the archive library reads.
struct UnpackedStream::Feed {
  ByteSource source;
  std::array<char, kUnpackedBytes> block;
  std::int64_t packed_bytes = 0;      ///< Bytes taken from the file.
  std::int64_t bytes_to_archive = 0;  ///< Bytes given to the library, after gzip was unpacked.

  /// `packed` with a count of its bytes.
  ByteSource counted(ByteSource packed) {
    return [this, packed = std::move(packed)](char* to, std::size_t bytes) {
      BytesRead count = packed(to, bytes);
      packed_bytes += static_cast<std::int64_t>(count.value_or(0));
      return count;
    };
  }

  static la_ssize_t next(struct archive* archive, void* data, const void** bytes) {
    auto& self = *static_cast<Feed*>(data);
    const BytesRead count = self.source(self.block.data(), self.block.size());
    *bytes = self.block.data();
    self.bytes_to_archive += static_cast<std::int64_t>(count.value_or(0));
    if (count) return static_cast<la_ssize_t>(*count);
    archive_set_error(archive, EIO, "%s", count.error().c_str());
    return -1;
  }
};

void UnpackedStream::ArchiveDeleter::operator()(struct archive* opened) const { archive_read_free(opened); }

UnpackedStream::UnpackedStream(ByteSource packed, std::string name, bool is_chunk)
    : name_(std::move(name)), feed_(std::make_unique<Feed>()), archive_(archive_read_new()) {
  archive_read_support_filter_bzip2(archive_.get());
  archive_read_support_filter_xz(archive_.get());
  if (is_chunk) archive_read_support_filter_lz4(archive_.get());
  archive_read_support_format_raw(archive_.get());
  archive_read_support_format_empty(archive_.get());
  auto source = withoutGzip(feed_->counted(std::move(packed)), !is_chunk);
  if (!source) {
    failure_ = source.error();
    return;
  }
  feed_->source = std::move(*source);
  struct archive_entry* entry = nullptr;
  int result = archive_read_open(archive_.get(), feed_.get(), nullptr, &Feed::next, nullptr);
  if (result == ARCHIVE_OK) result = archive_read_next_header(archive_.get(), &entry);
  at_end_ = result == ARCHIVE_EOF;
  if (result != ARCHIVE_OK && !at_end_) failure_ = archiveError();
}

UnpackedStream::UnpackedStream(const std::filesystem::path& file)
    : UnpackedStream(sourceOf(file), file.string(), false) {
  UnpackedStream again(sourceOf(file), name_, false);
  std::array<char, 256> beginning{};
  std::size_t count = 0;
  while (count < beginning.size()) {
    const std::size_t read = again.read(beginning.data() + count, beginning.size() - count).value_or(0);
    if (read == 0) break;
    count += read;
  }
  if (auto problem = common::problemOfPointer(file, {beginning.data(), count})) {
    problem->hint += ", then pack it again";
    throw common::InputError(*std::move(problem));
  }
}

UnpackedStream UnpackedStream::fromBytes(std::string_view bytes, std::string name) {
  return {sourceOf(bytes), std::move(name), false};
}

UnpackedStream UnpackedStream::fromSource(ByteSource source, std::string name) {
  return {std::move(source), std::move(name), true};
}

UnpackedStream::~UnpackedStream() = default;
UnpackedStream::UnpackedStream(UnpackedStream&&) noexcept = default;
UnpackedStream& UnpackedStream::operator=(UnpackedStream&&) noexcept = default;

BytesRead UnpackedStream::read(char* to, std::size_t bytes) {
  while (unpacked_.empty() && failure_.empty() && !at_end_ && bytes > 0) unpackBlock();
  if (unpacked_.empty() && !failure_.empty()) return tl::unexpected(failure_);
  const std::size_t count = unpacked_.copy(to, bytes);
  unpacked_.remove_prefix(count);
  return count;
}

/// Reads block by block: archive_read_data fills a given buffer, and loses what it already has if a failure follows.
void UnpackedStream::unpackBlock() {
  const void* block = nullptr;
  std::size_t bytes = 0;
  la_int64_t offset = 0;
  const int result = archive_read_data_block(archive_.get(), &block, &bytes, &offset);
  if (result == ARCHIVE_OK) {
    unpacked_ = {static_cast<const char*>(block), bytes};
  } else if (result != ARCHIVE_EOF) {
    failure_ = archiveError();
  } else if (feed_->bytes_to_archive > archive_filter_bytes(archive_.get(), -1)) {
    // The library also ignores bytes that are not packed in the same format.
    failure_ = "it goes on behind its end";
  } else {
    at_end_ = true;
  }
}

std::string UnpackedStream::archiveError() const {
  const char* text = archive_error_string(archive_.get());
  return text == nullptr ? "damaged" : text;
}

std::int64_t UnpackedStream::packedBytesRead() const { return feed_->packed_bytes; }

std::filesystem::path unpackedName(const std::filesystem::path& file) {
  for (const char* packed : kPackedEndings)
    if (common::endingOf(file) == packed) return file.parent_path() / file.stem();
  return file;
}

std::string readUnpacked(const std::filesystem::path& file, std::size_t most_bytes) {
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  const auto fail = [&](Message message, const char* hint) {
    throw common::InputError({file.string()}, "", std::move(message), hint);
  };
  UnpackedStream stream(file);
  std::string bytes;
  for (;;) {
    const std::size_t before = bytes.size();
    if (before > most_bytes)
      fail(Message("file.unpacks-too-large", "holds more than {} MiB", most_bytes >> 20),
           "thin it, or write it with a coarser resolution");
    bytes.resize(before + kChunk);
    const BytesRead read = stream.read(bytes.data() + before, kChunk);
    if (!read)
      fail(Message("file.not-unpacked", "{}", read.error()),
           "give the whole file, plain or packed by gzip, bzip2 or xz");
    bytes.resize(before + *read);
    if (*read == 0) return bytes;
  }
}

}  // namespace swiftlet::interfaces
