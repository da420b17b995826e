#include "common/build_version.hpp"

#include <fmt/format.h>

namespace swiftlet::common {

std::string toString(const BuildVersion& version) {
  return fmt::format("{} (commit {}{})", version.number, version.commit, version.dirty == true ? ", changed" : "");
}

}  // namespace swiftlet::common
