#include "interfaces/files/unusable_folder.hpp"

#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include <linux/magic.h>

#include "interfaces/files/atomic_file.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::Message;

/// The folder itself, or the nearest one above it that is there.
fs::path nearestThere(const fs::path& folder) {
  std::error_code failure;
  fs::path there = fs::absolute(folder, failure).lexically_normal();
  while (there.has_relative_path() && !fs::exists(fs::symlink_status(there, failure))) there = there.parent_path();
  return there;
}

/// Whether it is a pseudo file system of the kernel: no right and no name helps there.
bool isOfTheKernel(const fs::path& there) {
  constexpr std::array<long, 5> kOfTheKernel{PROC_SUPER_MAGIC, SYSFS_MAGIC, CGROUP2_SUPER_MAGIC, DEBUGFS_MAGIC,
                                             SECURITYFS_MAGIC};
  struct statfs about = {};
  return ::statfs(there.c_str(), &about) == 0 &&
         std::find(kOfTheKernel.begin(), kOfTheKernel.end(), static_cast<long>(about.f_type)) != kOfTheKernel.end();
}

}  // namespace

common::Problem unusableFolder(const fs::path& folder, const std::error_code& why) {
  const fs::path there = nearestThere(folder);
  const auto problem = [&](Message message, const char* hint) {
    return common::Problem{{folder.string()}, "", std::move(message), hint};
  };
  const std::string name = there.string();
  std::error_code failure;
  if (isOfTheKernel(there))
    return problem(Message("folder.of-kernel", "`{}` holds no files of users, but what the kernel shows", name),
                   "give a folder on a disk, as runs/mine");
  if (!fs::is_directory(there, failure))
    return problem(fs::is_symlink(fs::symlink_status(there, failure)) && !fs::exists(there, failure)
                       ? Message("folder.broken-link", "`{}` is a link to what is not there", name)
                       : Message("folder.below-file", "`{}` is a file, and no folder can be made there", name),
                   "give the name of a folder");
  switch (why.value()) {
    case EACCES:
    case EPERM:
      return problem(Message("folder.no-right", "nothing can be written to `{}`: {}", name, why.message()),
                     "give a folder of yours, as runs/mine");
    case EROFS:
      return problem(Message("folder.read-only", "`{}` is mounted read-only", name), "give a folder on another disk");
    case ENOSPC:
    case EDQUOT:
      return problem(Message("folder.disk-full", "the disk of `{}` is full: {}", name, why.message()),
                     "make room there, or give a folder on another disk");
    case ENAMETOOLONG:
      return problem(Message("folder.name-too-long", "the name is too long for a file system"), "give a shorter one");
    default:
      return problem(Message("folder.not-usable", "cannot be used: {}", why.message()), "give another folder");
  }
}

void requireWritableFolder(const fs::path& folder, const std::string& option) {
  const auto refuse = [&](const std::error_code& why) {
    common::Problem problem = unusableFolder(folder, why);
    problem.element = option;
    throw common::InputError(std::move(problem));
  };
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) refuse(failure);
  if (const Written written = tryToWrite(folder / "writable"); !written) refuse(written.error().why);
}

}  // namespace swiftlet::interfaces
