// The folder of a run: the right to write into it, and its files from an older run.
#pragma once

#include <filesystem>

#include "interfaces/files/folder_lock.hpp"

namespace swiftlet::interfaces {

/// The vehicle's memory at the begin of a flight, and after it, where it is kept.
inline constexpr const char* kMemoryReadFile = "vehicle_memory_read.yaml";
inline constexpr const char* kMemoryLearnedFile = "vehicle_memory_learned.yaml";

// These throw common::InputError for a folder that cannot hold a run: no folder, in use by another flight, or with
// other files than a run's.

/// Makes the folder if it is missing, and locks it.
FolderLock claimedRunFolder(const std::filesystem::path& path);

/// Removes the files of an older run from a claimed folder; returns it.
const std::filesystem::path& clearedRunFolder(const std::filesystem::path& path);

/// Changes nothing.
void checkRunFolder(const std::filesystem::path& folder);

}  // namespace swiftlet::interfaces
