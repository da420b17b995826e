// What is known of each scan of a log, until all of it is known.
#pragma once

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
  /// Throws InputError when there is no room for temporary files.
  Spool() : file_(std::tmpfile()) {
    if (!file_) throw common::InputError(common::Problem{{}, "", "no temporary file can be made", "is the disk full?"});
  }

  void add(const Record& record) {
    if (std::fwrite(&record, sizeof record, 1, file_.get()) != 1)
      throw common::InputError(
          common::Problem{{}, "", "the temporary file of the trajectory cannot be written", "is the disk full?"});
  }

  template <typename Use>
  void forEach(const Use& use) const {
    std::rewind(file_.get());
    for (Record record; std::fread(&record, sizeof record, 1, file_.get()) == 1;) use(record);
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace swiftlet::apps
