// Finds what Swiftlet brings along: missions, worlds, profiles and trials, named as they stand in the source tree
// ("missions/explore_and_return.xml"). Touches the file system only while called; safe from any thread.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace swiftlet::common {

/// Where findData looks, in order: the folder the user stands in, $SWIFTLET_DATA, share/swiftlet beside the bin/ of the
/// running program (installed), and the source tree it was built from. Only those that exist.
std::vector<std::filesystem::path> dataFolders();

/// The file or folder `name`, searched in dataFolders(); an absolute path is taken as it is.
/// Throws InputError where there is none: with the folders it looked in and the most similar name that is there.
std::filesystem::path findData(const std::filesystem::path& name);

}  // namespace swiftlet::common
