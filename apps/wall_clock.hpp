// Measures real time.
#pragma once

#include <chrono>

namespace swiftlet::apps {

using Clock = std::chrono::steady_clock;

inline double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace swiftlet::apps
