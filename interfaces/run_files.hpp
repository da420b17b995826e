// The folder of a run: who may write into it, and which of its files are those of an older run.
#pragma once

#include <filesystem>

#include "interfaces/files/folder_lock.hpp"

namespace swiftlet::interfaces {

/// What a flight knew of the vehicle when it began, and what it learned, where that is kept.
inline constexpr const char* kMemoryReadFile = "vehicle_memory_read.yaml";
inline constexpr const char* kMemoryLearnedFile = "vehicle_memory_learned.yaml";

// These throw common::InputError for a folder that cannot hold a run: it is none, another flight writes into it, or it
// holds what is no run.

/// Makes the folder if there is none, and keeps others from it.
FolderLock claimedRunFolder(const std::filesystem::path& path);

/// Removes the files of an older run from a claimed folder; returns it.
const std::filesystem::path& clearedRunFolder(const std::filesystem::path& path);

/// Changes nothing.
void checkRunFolder(const std::filesystem::path& folder);

}  // namespace swiftlet::interfaces
