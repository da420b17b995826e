// A server with an artificial flight behind it, in its own threads: for tests over sockets and for the browser test.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/rendering/example_flight.hpp"
#include "web/server/web_server.hpp"

namespace swiftlet::testing {

/// Seconds since 1970.
common::Time unixTime();

class FakeBackend {
 public:
  struct Setup {
    std::string address = "127.0.0.1";
    int port = 0;
    std::string token = "operator-token";
    double worlds_per_second = 20.0;
    bool answers = true;  ///< If false, commands are not answered.
    bool flies = true;    ///< If false, no world is ever posted.
    bool maps3d = false;  ///< If true, the vehicle carries an RGB-D camera.
    double stall_timeout_s = 10.0;
    int max_connections = 256;
    double viewers_bytes_per_s = 16e6;
    double warm_up_s = 4.0;  ///< Flown time before the first world.
  };

  explicit FakeBackend(Setup setup);
  ~FakeBackend();

  web::WebServer& server() { return *server_; }
  int port() const { return server_->port(); }
  std::vector<common::OperatorCommand> commandsSeen() const;
  /// Processor time of the server's thread.
  double serverCpu_s() const;

 private:
  void fly(const std::stop_token& stop);
  common::CommandResult carryOut(const common::OperatorCommand& command);

  Setup setup_;
  ExampleFlight flight_;
  common::LatestValue<common::World> world_;
  common::LatestValue<common::CameraFrame> camera_;
  common::LosslessQueue<common::OperatorCommand> commands_;
  common::LosslessQueue<common::CommandResult> results_;
  mutable std::mutex seen_mutex_;
  std::vector<common::OperatorCommand> seen_;
  web::IoContext io_;
  std::unique_ptr<web::WebServer> server_;
  std::jthread server_thread_;
  std::jthread flight_thread_;
};

}  // namespace swiftlet::testing
