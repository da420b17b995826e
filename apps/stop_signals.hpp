// Lets Ctrl-C, SIGTERM and a closed terminal end a flight in order.
#pragma once

#include <atomic>

namespace swiftlet::apps {

/// After this call SIGINT, SIGTERM and SIGHUP raise this flag instead of ending the process.
const std::atomic<bool>& stopOnSignals();

}  // namespace swiftlet::apps
