// Which sources a program was built from. A run keeps it, so that the flight can be repeated later.
#pragma once

#include <optional>
#include <string>

namespace swiftlet::common {

struct BuildVersion {
  std::string number = {};         ///< Of the release: "0.2.0".
  std::string commit = "unknown";  ///< The first 12 digits, where the sources were a git checkout.
  std::optional<bool> dirty = {};  ///< Whether the sources differed from the commit; nullopt without a commit.
};

/// For people: "0.2.0 (commit 5e2b3b0f1c4d)", "0.2.0 (commit 5e2b3b0f1c4d, changed)" or "0.2.0 (commit unknown)".
std::string toString(const BuildVersion& version);

}  // namespace swiftlet::common
