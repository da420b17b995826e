// Ctrl-C and SIGTERM end a flight in order.
#pragma once

#include <atomic>

namespace swiftlet::apps {

/// From now on SIGINT and SIGTERM raise this flag instead of ending the process.
const std::atomic<bool>& stopOnSignals();

}  // namespace swiftlet::apps
