#include "apps/results_folder.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAskForAnother = "give an empty or new folder by --out";

bool isFileOf(const ResultsKind& kind, const std::string& name) {
  // A `.part` is what a killed process left of a file of ours.
  return std::any_of(kind.files.begin(), kind.files.end(), [&](const std::string& file) {
    return name == file || (name.starts_with(file + ".") && name.ends_with(".part"));
  });
}

common::InputError unusable(const fs::path& path, const std::string& message, const std::string& hint) {
  return common::InputError(common::Problem{{path.string()}, "", message, hint});
}

}  // namespace

ResultsFolder::ResultsFolder(fs::path path, const ResultsKind& kind) : path_(std::move(path)) {
  try {
    if (fs::exists(path_) && !fs::is_directory(path_)) throw unusable(path_, "is not a folder", kAskForAnother);
    made_ = fs::create_directories(path_);
    lock_.emplace(path_);
    if (lock_->refused()) throw unusable(path_, "is being written by another run", kAskForAnother);
    if (!made_) refuseWhatIsNot(kind);
  } catch (const fs::filesystem_error& e) {
    throw unusable(path_, fmt::format("cannot be used: {}", e.code().message()), "");
  }
}

void ResultsFolder::refuseWhatIsNot(const ResultsKind& kind) const {
  bool empty = true;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_regular_file() || !isFileOf(kind, name))
      throw unusable(path_, fmt::format("holds `{}`, which is no file of a {}", name, kind.noun), kAskForAnother);
    empty = false;
  }
  // A flight, or what another program wrote, has files of the same names.
  if (!empty && !interfaces::saysAtStart(path_ / "report.html", "<title>" + kind.title, 400))
    throw unusable(path_, fmt::format("holds no {} of this program, and what it holds would be lost", kind.noun),
                   kAskForAnother);
}

ResultsFolder::~ResultsFolder() {
  std::error_code ignored;
  if (made_ && fs::is_empty(path_, ignored)) fs::remove(path_, ignored);
}

}  // namespace swiftlet::apps
