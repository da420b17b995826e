// The event loop the web server runs on, without Boost in the header. The application owns the thread:
//
//   web::IoContext io;
//   web::WebServer server(io, ...);
//   std::jthread thread([&] { io.run(); });
//   ...
//   server.stop();   // run() returns once everything is closed
#pragma once

#include <memory>

namespace boost::asio {
class io_context;
}

namespace swiftlet::web {

class IoContext {
 public:
  IoContext();
  ~IoContext();
  IoContext(const IoContext&) = delete;
  IoContext& operator=(const IoContext&) = delete;

  /// Serves until nothing is left to do. Call it from exactly one thread.
  void run();

  boost::asio::io_context& get() { return *context_; }

 private:
  std::unique_ptr<boost::asio::io_context> context_;
};

}  // namespace swiftlet::web
