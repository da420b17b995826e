// Blocking clients for the socket tests, and waiting for what the server does in its own thread.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "tests/support/patience.hpp"

namespace swiftlet::testing {

struct Reply {
  int status = 0;
  std::map<std::string, std::string> headers;  ///< Names in lower case.
  std::string body;
};

/// A raw TCP connection to the server; every read gives up after `timeout_s` of a release build and returns what
/// it has.
class RawClient {
 public:
  explicit RawClient(int port, double timeout_s = 5.0);

  void send(const std::string& bytes);
  /// Up to and with `end`; shorter at the end of the connection or the timeout.
  std::string readUntil(const std::string& end);
  std::string readBytes(std::size_t count);
  /// A whole reply with Content-Length.
  Reply readReply();
  /// The server has closed the connection.
  bool closed();
  int nativeSocket() { return socket_.native_handle(); }

 private:
  bool fill();
  boost::asio::io_context io_;
  boost::asio::ip::tcp::socket socket_;
  std::string buffer_;
};

/// True as soon as `holds` does, within five seconds of a release build.
template <typename Holds>
bool eventually(Holds holds) {
  for (int i = 0; i < 500 * test_support::patience(); ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// One request on a new connection. `extra` are header lines with their ends.
Reply request(int port, const std::string& method, const std::string& target, const std::string& extra = "",
              const std::string& body = "");

/// "Authorization: Bearer ..." of the fake backend.
std::string bearer();

}  // namespace swiftlet::testing
