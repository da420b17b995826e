#include "simulated_flight/flights_in_parallel.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace swiftlet::simulated_flight {

void flyInParallel(int count, int jobs, const std::atomic<bool>& stop, const std::function<void(int)>& fly) {
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (int i = next++; i < count && !stop; i = next++) {
      try {
        fly(i);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < std::min(jobs, count); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace swiftlet::simulated_flight
