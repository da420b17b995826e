#include "flight/memory_watch.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace swiftlet::flight {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{50};

/// Linux counts it in units of 1024 bytes.
double greatestEver_MB() {
  rusage usage{};
  return ::getrusage(RUSAGE_SELF, &usage) == 0 ? 1.024e-3 * static_cast<double>(usage.ru_maxrss) : 0.0;
}

double resident_MB() {
  std::ifstream file("/proc/self/statm");
  double all_pages = 0.0, resident_pages = 0.0;
  file >> all_pages >> resident_pages;
  return 1e-6 * static_cast<double>(::sysconf(_SC_PAGESIZE)) * resident_pages;
}

}  // namespace

MemoryWatch::MemoryWatch()
    : before_MB_(greatestEver_MB()), seen_MB_(resident_MB()), next_(Clock::now() + kBetweenLooks) {}

void MemoryWatch::look() {
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + kBetweenLooks;
  seen_MB_ = std::max(seen_MB_, resident_MB());
}

double MemoryWatch::peak_MB() {
  const double greatest_MB = greatestEver_MB();
  return greatest_MB > before_MB_ ? greatest_MB : std::max(seen_MB_, resident_MB());
}

}  // namespace swiftlet::flight
