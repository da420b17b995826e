// Stores data of each scan of a log until the whole log is read.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <type_traits>

#include "common/error.hpp"

namespace swiftlet::apps {

/// Records in the order they were added, kept on disk: a log may be longer than memory. Used by one thread.
template <typename Record>
class Spool {
  static_assert(std::is_trivially_copyable_v<Record>, "it is written as it lies in memory");

 public:
  /// Throws InputError if there is no room for temporary files.
  Spool() : file_(std::tmpfile()) {
    if (!file_)
      throw common::InputError({}, "", common::Message("spool.not-made", "no temporary file can be made"),
                               "is /tmp full?");
  }

  /// Throws InputError if there is no room left.
  void add(const Record& record) {
    if (std::fwrite(&record, sizeof record, 1, file_.get()) != 1) throw full();
    ++records_;
  }

  /// Throws InputError if a record did not reach the disk: it gives all records or an error.
  template <typename Use>
  void forEach(const Use& use) const {
    // The last records may still be in memory, and rewind() would not report a full disk.
    if (std::fflush(file_.get()) != 0 || std::fseek(file_.get(), 0, SEEK_SET) != 0) throw full();
    std::uint64_t read = 0;
    for (Record record; std::fread(&record, sizeof record, 1, file_.get()) == 1; ++read) use(record);
    if (read != records_) throw full();
  }

 private:
  static common::InputError full() {
    return common::InputError(
        {}, "", common::Message("spool.not-written", "the temporary file of the trajectory cannot be written"),
        "is /tmp full?");
  }

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t records_ = 0;
};

}  // namespace swiftlet::apps
