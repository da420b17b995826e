#include "apps/results_folder.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "interfaces/files/text_file.hpp"
#include "interfaces/files/unusable_folder.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAskForAnother = "give an empty or new folder by --out";
constexpr const char* kUnfinished = "unfinished.part";

bool isFileOf(const ResultsKind& kind, const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  return entry.is_regular_file() && std::find(kind.files.begin(), kind.files.end(), name) != kind.files.end();
}

/// Remains of a killed run; its files may have been about to be renamed.
bool isUnfinished(const ResultsKind& kind, const fs::directory_entry& entry) {
  if (entry.path().filename() != kUnfinished || entry.is_symlink() || !entry.is_directory()) return false;
  return std::all_of(fs::directory_iterator(entry), fs::directory_iterator(), [&](const fs::directory_entry& within) {
    return isFileOf(kind, within) || (within.is_regular_file() && within.path().extension() == ".part");
  });
}

common::InputError unusable(const fs::path& path, const common::Message& message, const std::string& hint) {
  return common::InputError({path.string()}, "", message, hint);
}

}  // namespace

ResultsFolder::ResultsFolder(fs::path path, const ResultsKind& kind)
    : path_(std::move(path)), unfinished_(path_ / kUnfinished), kind_(kind) {
  try {
    if (fs::exists(path_) && !fs::is_directory(path_))
      throw unusable(path_, common::Message("folder.none", "is not a folder"), kAskForAnother);
    made_ = fs::create_directories(path_);
    lock_.emplace(path_);
    if (lock_->refused())
      throw unusable(path_, common::Message("results.in-use", "is being written by another run"), kAskForAnother);
    if (!made_) refuseForeignFiles();
    // Before the work, so that a folder that cannot be written is reported at once.
    fs::remove_all(unfinished_);
    fs::create_directory(unfinished_);
  } catch (const fs::filesystem_error& e) {
    throw common::InputError(interfaces::unusableFolder(path_, e.code()));
  }
}

void ResultsFolder::refuseForeignFiles() const {
  bool empty = true;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
    if (isUnfinished(kind_, entry)) continue;
    if (!isFileOf(kind_, entry))
      throw unusable(path_,
                     common::Message("results.other-file", "holds `{}`, which is no file of a {}",
                                     entry.path().filename().string(), kind_.noun),
                     kAskForAnother);
    empty = false;
  }
  // A flight, or another program, writes files of the same names.
  if (!empty && !interfaces::saysAtStart(path_ / kind_.proof, kind_.proof_text, 400))
    throw unusable(
        path_,
        common::Message("results.none", "holds no {} of this program, and what it holds would be lost", kind_.noun),
        kAskForAnother);
}

void ResultsFolder::publish() {
  try {
    // The proof file first: after an interruption at any point the folder is still recognized.
    fs::rename(unfinished_ / kind_.proof, path_ / kind_.proof);
    for (const std::string& file : kind_.files) {
      if (file == kind_.proof) continue;
      if (fs::exists(unfinished_ / file))
        fs::rename(unfinished_ / file, path_ / file);
      else
        fs::remove(path_ / file);
    }
  } catch (const fs::filesystem_error& e) {
    throw unusable(path_, common::Message("folder.not-written", "cannot be written: {}", e.code().message()), "");
  }
}

ResultsFolder::~ResultsFolder() {
  std::error_code ignored;
  fs::remove_all(unfinished_, ignored);
  if (made_ && fs::is_empty(path_, ignored)) fs::remove(path_, ignored);
}

}  // namespace swiftlet::apps
