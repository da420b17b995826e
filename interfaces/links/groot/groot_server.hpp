// The socket of Groot2's monitor protocol: a ZeroMQ reply socket.
#pragma once

#include <memory>

#include "interfaces/links/groot/groot_monitor.hpp"

namespace swiftlet::interfaces {

/// Whether this build has ZeroMQ (libzmq3-dev).
bool hasGrootServer();

/// One thread.
class GrootServer {
 public:
  /// Listens on the port of every IPv4 address that `address` names ("127.0.0.1", "0.0.0.0"); port 0 for any free one.
  /// Throws common::InputError if it cannot, or if this build has no ZeroMQ.
  GrootServer(const std::string& address, int port);
  ~GrootServer();
  GrootServer(const GrootServer&) = delete;
  GrootServer& operator=(const GrootServer&) = delete;

  int port() const;
  /// Waits for a request, at most for `patience_ms`, and answers it. False if none came.
  bool serve(GrootMonitor& monitor, int patience_ms);

 private:
  struct Socket;
  std::unique_ptr<Socket> socket_;
};

}  // namespace swiftlet::interfaces
