// Real data, if this machine has it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <gtest/gtest.h>

namespace swiftlet::test_support {

/// The folder of the data sets: SWIFTLET_DATASETS, or ../shared/datasets beside the source tree.
inline std::filesystem::path dataSetsFolder() {
  const char* told = std::getenv("SWIFTLET_DATASETS");
  if (told != nullptr && *told != '\0') return told;
  return std::filesystem::path(SWIFTLET_SOURCE_DIR) / "../shared/datasets";
}

/// A file or folder of the data sets. If it is not on this machine, the result is none; the test is then marked as
/// skipped with what it lacks, and only has to return.
inline std::optional<std::filesystem::path> dataSet(const std::string& relative) {
  const std::filesystem::path path = dataSetsFolder() / relative;
  if (std::filesystem::exists(path)) return path;
  [&] { GTEST_SKIP() << "skipped: no data set " << path << "; set SWIFTLET_DATASETS"; }();
  return std::nullopt;
}

}  // namespace swiftlet::test_support
