#include "flight/stop_signals.hpp"

#include <csignal>

namespace swiftlet::flight {
namespace {

StopSignals requested;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may use it");

/// A closed terminal often follows a SIGTERM, so that it is never the second request.
extern "C" void requestStop(int signal) {
  if (requested.first.exchange(true) && signal != SIGHUP) requested.second = true;
}

}  // namespace

const StopSignals& stopOnSignals() {
  for (const int stops : {SIGINT, SIGTERM, SIGHUP}) std::signal(stops, requestStop);
  return requested;
}

}  // namespace swiftlet::flight
