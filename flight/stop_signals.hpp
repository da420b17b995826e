// Lets Ctrl-C, SIGTERM and a closed terminal end a flight in order.
#pragma once

#include <atomic>

namespace swiftlet::flight {

/// Requests by signals; each flag stays up once it is raised.
struct StopSignals {
  std::atomic<bool> first{false};   ///< The first SIGINT, SIGTERM or SIGHUP has come.
  std::atomic<bool> second{false};  ///< A second SIGINT or SIGTERM has come.
};

/// After this call these signals raise the flags instead of ending the process.
const StopSignals& stopOnSignals();

}  // namespace swiftlet::flight
