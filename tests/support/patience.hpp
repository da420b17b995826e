// How slow this build may be. It scales limits of real time in tests, never what they check.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace swiftlet::test_support {

/// How many times longer than a release build this one may take; ctest sets it for sanitized builds.
inline int patience() {
  const char* factor = std::getenv("SWIFTLET_TEST_PATIENCE");
  return factor ? std::max(1, std::atoi(factor)) : 1;
}

}  // namespace swiftlet::test_support
