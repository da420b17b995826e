#include "apps/output_file.hpp"

#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "common/error.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::apps {

namespace fs = std::filesystem;

void requireWritable(const fs::path& file, const std::string& option, std::string_view first_line) {
  const auto unusable = [&](const std::string& message, const std::string& hint) {
    return common::InputError(common::Problem{{file.string()}, option, message, hint});
  };
  std::error_code failure;
  const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  if (!fs::is_directory(folder, failure)) throw unusable("its folder does not exist", "make the folder first");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw unusable("nothing can be written to its folder", "give one in a folder of yours");
  const fs::file_status status = fs::status(file, failure);
  if (fs::is_directory(status) || file.filename().empty())
    throw unusable("is a folder", "give the name of a file in it");
  if (!fs::exists(fs::symlink_status(file, failure))) return;
  if (!fs::is_regular_file(status)) throw unusable("is there already, and no file", "give another name");
  const bool is_ours =
      fs::file_size(file, failure) == 0 || interfaces::saysAtStart(file, first_line, first_line.size());
  if (!is_ours)
    throw unusable(fmt::format("is there already, and does not begin with `{}`", first_line),
                   "give another name: what it holds would be lost");
}

}  // namespace swiftlet::apps
