#include "interfaces/files/archive.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <system_error>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <unistd.h>

#include "common/error.hpp"
#include "common/hash.hpp"
#include "common/read_bytes.hpp"
#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;

constexpr std::int64_t kMaxUnpackedBytes = std::int64_t{4} << 30;

struct ReaderDeleter {
  void operator()(struct archive* reader) const { archive_read_free(reader); }
};
using Reader = std::unique_ptr<struct archive, ReaderDeleter>;

/// Removes what was unpacked so far, unless it is released to the caller.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(fs::path path) : path_(std::move(path)) {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    fs::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

class Unpacking {
 public:
  Unpacking(const fs::path& archive, const fs::path& into) : archive_(archive), into_(into) {}

  void run(const std::string& bytes) {
    const Reader reader(archive_read_new());
    archive_read_support_filter_all(reader.get());
    archive_read_support_format_tar(reader.get());
    archive_read_support_format_zip(reader.get());
    check(reader.get(), archive_read_open_memory(reader.get(), bytes.data(), bytes.size()), "");
    struct archive_entry* entry = nullptr;
    int result = ARCHIVE_OK;
    int entries = 0;
    for (; (result = archive_read_next_header(reader.get(), &entry)) == ARCHIVE_OK; ++entries)
      unpack(reader.get(), entry);
    if (result != ARCHIVE_EOF) check(reader.get(), result, "");
    if (entries == 0) throw fail("", Message("archive.empty", "holds nothing"));
  }

 private:
  void unpack(struct archive* reader, struct archive_entry* entry) {
    const char* raw_name = archive_entry_pathname(entry);
    const std::string name = raw_name == nullptr ? "" : raw_name;
    const fs::path target = into_ / checkedName(name);
    const auto type = archive_entry_filetype(entry);
    const bool link = archive_entry_hardlink(entry) != nullptr || archive_entry_symlink(entry) != nullptr;
    if (type == AE_IFDIR && !link) {
      fs::create_directories(target);
      return;
    }
    if (type != AE_IFREG || link) throw fail(name, Message("archive.no-file", "is neither a file nor a folder"));
    fs::create_directories(target.parent_path());
    if (const Written written = writeAtomically(target, contentOf(reader, name)); !written)
      throw InputError({}, "", written.error().message);
  }

  fs::path checkedName(const std::string& name) const {
    fs::path path(name);
    if (name.empty() || path.is_absolute()) throw fail(name, Message("archive.not-relative", "has no relative name"));
    for (const fs::path& part : path)
      if (part == "..") throw fail(name, Message("archive.leads-out", "leads out of the folder"));
    return path;
  }

  std::string contentOf(struct archive* reader, const std::string& name) {
    std::string content;
    char block[1 << 16];
    la_ssize_t count = 0;
    while ((count = archive_read_data(reader, block, sizeof block)) > 0) {
      unpacked_bytes_ += count;
      if (unpacked_bytes_ > kMaxUnpackedBytes)
        throw fail(name, Message("archive.too-large", "makes the archive too large"));
      content.append(block, static_cast<std::size_t>(count));
    }
    if (count < 0) check(reader, static_cast<int>(count), name);
    return content;
  }

  void check(struct archive* reader, int result, const std::string& name) const {
    if (result == ARCHIVE_OK) return;
    const char* text = archive_error_string(reader);
    throw fail(name, Message("archive.not-unpacked", "cannot be unpacked{}{}", text == nullptr ? "" : ": ",
                             text == nullptr ? "" : text));
  }

  InputError fail(const std::string& entry, Message message) const {
    return InputError({archive_.string()}, entry, std::move(message));
  }

  fs::path archive_;
  fs::path into_;
  std::int64_t unpacked_bytes_ = 0;
};

}  // namespace

fs::path unpackInto(const fs::path& cache, const fs::path& archive) {
  const std::string bytes = common::readBytes(archive, std::size_t{4} << 30);
  const std::string stem = archive.filename().string().substr(0, archive.filename().string().find('.'));
  fs::path folder = cache / fmt::format("{}-{:016x}", stem, common::fnv1a(bytes));
  if (fs::is_directory(folder)) return folder;
  try {
    const TemporaryFolder temporary(cache / fmt::format(".{}.{}.part", folder.filename().string(), ::getpid()));
    Unpacking(archive, temporary.path()).run(bytes);
    std::error_code failure;
    fs::rename(temporary.path(), folder, failure);
    if (failure && !fs::is_directory(folder)) throw fs::filesystem_error("rename", folder, failure);
  } catch (const fs::filesystem_error& e) {
    throw InputError({cache.string()}, "", Message("folder.not-written", "cannot be written: {}", e.code().message()));
  }
  return folder;
}

}  // namespace swiftlet::interfaces
