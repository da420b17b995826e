// Flies several flights at the same time.
#pragma once

#include <atomic>
#include <functional>

namespace swiftlet::simulated_flight {

/// Calls fly(i) for each i below `count` in order, up to `jobs` of them at the same time from as many threads, and
/// returns when all are over. No call begins after `stop` is set or one has thrown: that exception is thrown again.
void flyInParallel(int count, int jobs, const std::atomic<bool>& stop, const std::function<void(int)>& fly);

}  // namespace swiftlet::simulated_flight
