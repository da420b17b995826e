#include "flight/wall_clock.hpp"

#include <thread>

namespace swiftlet::flight {

void Pace::waitUntil(common::Time time) const {
  if (speed_ <= 0.0) return;
  const std::chrono::duration<double> wall((time - begin_).seconds() / speed_);
  std::this_thread::sleep_until(wall_begin_ + std::chrono::duration_cast<Clock::duration>(wall));
}

void lingerForPages(const std::atomic<bool>* stop) {
  constexpr double kUsual_s = 2.0, kInHaste_s = 0.5;  // Several snapshots of the page.
  const Clock::time_point begin = Clock::now();
  while (secondsSince(begin) < (stop && *stop ? kInHaste_s : kUsual_s))
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

}  // namespace swiftlet::flight
