// Finds the data files of Swiftlet: missions, worlds, profiles and trials, named by their path in the source tree
// ("missions/explore_and_return.xml"). Reads the file system only while called; safe from any thread.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace swiftlet::common {

/// The folders that findData searches, in order: the current folder, $SWIFTLET_DATA, share/swiftlet beside the bin/ of
/// the running program (installed), and the source tree it was built from. Only those that exist.
std::vector<std::filesystem::path> dataFolders();

/// The path of the file or folder `name`, searched in dataFolders(); an absolute path, also one that is written as the
/// address file:///PATH, is used as it is.
/// Throws InputError if it does not exist, with the folders searched and the most similar name that exists.
std::filesystem::path findData(const std::filesystem::path& name);

/// The path of `name` in `folder` if it is there, else that by findData. What is there and cannot be followed, such as
/// a loop of links, is not searched elsewhere: reading it says why. Throws as findData() does, with `folder` too.
std::filesystem::path findBeside(const std::filesystem::path& folder, const std::filesystem::path& name);

}  // namespace swiftlet::common
