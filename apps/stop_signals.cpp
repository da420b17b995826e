#include "apps/stop_signals.hpp"

#include <csignal>

namespace swiftlet::apps {
namespace {

std::atomic<bool> stop_requested{false};
extern "C" void requestStop(int) { stop_requested = true; }

}  // namespace

const std::atomic<bool>& stopOnSignals() {
  for (const int stops : {SIGINT, SIGTERM, SIGHUP}) std::signal(stops, requestStop);
  return stop_requested;
}

}  // namespace swiftlet::apps
