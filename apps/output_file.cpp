#include "apps/output_file.hpp"

#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/text_file.hpp"
#include "interfaces/files/unusable_folder.hpp"

namespace swiftlet::apps {

namespace fs = std::filesystem;

namespace {

common::InputError unusable(const fs::path& file, const std::string& option, const common::Message& message,
                            const std::string& hint) {
  return common::InputError({file.string()}, option, message, hint);
}

}  // namespace

void requireWritable(const fs::path& file, const std::string& option) {
  std::error_code failure;
  const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  if (!fs::is_directory(folder, failure))
    throw unusable(file, option, common::Message("file.no-folder", "its folder does not exist"),
                   "make the folder first");
  const fs::file_status status = fs::status(file, failure);
  if (fs::is_directory(status) || file.filename().empty())
    throw unusable(file, option, common::Message("file.is-folder", "is a folder, a file was expected"),
                   "give the name of a file in it");
  if (fs::exists(fs::symlink_status(file, failure)) && !fs::is_regular_file(status))
    throw unusable(file, option, common::Message("file.is-other", "is there already, and no file"),
                   "give another name");
  if (const interfaces::Written written = interfaces::tryToWrite(file); !written) {
    common::Problem problem = interfaces::unusableFolder(folder, written.error().why);
    problem.location.file = file.string();
    problem.element = option;
    throw common::InputError(std::move(problem));
  }
}

void requireWritable(const fs::path& file, const std::string& option, std::string_view first_line) {
  requireWritable(file, option);
  std::error_code failure;
  if (!fs::exists(file, failure) || fs::file_size(file, failure) == 0 ||
      interfaces::saysAtStart(file, first_line, first_line.size()))
    return;
  throw unusable(file, option,
                 common::Message("file.of-others", "is there already, and does not begin with `{}`", first_line),
                 "give another name: what it holds would be lost");
}

}  // namespace swiftlet::apps
