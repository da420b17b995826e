// A server with an artificial flight behind it, in its own threads: for tests over sockets and for the browser test.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/rendering/example_flight.hpp"
#include "web/server/mission_shelf.hpp"
#include "web/server/web_server.hpp"

namespace swiftlet::testing {

/// Seconds since 1970.
common::Time unixTime();

/// Two missions, one of them with parameters.
class FakeShelf final : public web::MissionShelf {
 public:
  std::string list() override;
  tl::expected<common::StartMissionCommand, std::string> take(
      const std::string& file, const std::map<std::string, std::string>& parameters) override;
};

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
    bool given = false;   ///< If true, the flight has a given map and knows its place in it.
    int tree_nodes = 0;   ///< If not 0, the mission's tree has so many nodes, and some of them change in each world.
    double stall_timeout_s = 10.0;
    int max_connections = 256;
    std::vector<std::string> public_urls = {};
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
  void postWorld(bool moves, double seconds);
  void growTree();
  void giveMap();
  common::CommandResult carryOut(const common::OperatorCommand& command);

  Setup setup_;
  FakeShelf shelf_;
  ExampleFlight flight_;
  common::TreeView tree_;
  int worlds_ = 0;
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
