// The operator's page, its live state and the picture streams, over HTTP and WebSocket. It reads telemetry and hands
// over commands; it can delay or change nothing in the flight.
//
//   GET  /                        the page, embedded in the program; no other host is needed
//   GET  /stream/map.mjpg         ?width= &height= &fps= &scheme=light|dark; multipart/x-mixed-replace
//   GET  /stream/camera.mjpg      ?width= &fps=
//   GET  /api/state               everything as one JSON document
//   GET  /api/map.png             the picture of the map; ?width= &height= &scheme=
//   GET  /api/ws                  WebSocket: what /api/state has, in parts and only what changed, and the map's tiles
//   POST /api/goal|hold|resume|home|land    `Authorization: Bearer TOKEN` or ?token=; goal: {"x_m": 1.0, "y_m": 2.0}
//
// Streams: a picture is encoded once for all clients that asked for the same; each client has at most one frame under
// way and gets the newest when it is ready again, so that a slow client costs and delays nobody, and its own picture
// is never older than one frame. Requests whose Host is neither an address nor a name of this machine, or whose Origin
// is foreign, are refused (no DNS rebinding, no CSRF).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/command.hpp"
#include "common/event.hpp"
#include "common/mailbox.hpp"
#include "common/sensor_event.hpp"
#include "web/server/io_context.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::web {

class WebServer {
 public:
  struct Options {
    std::string address = "127.0.0.1";  ///< IPv4 or IPv6 to listen on; "0.0.0.0" is every interface.
    int port = 8080;                    ///< 0: any free one.
    std::string token;                  ///< What an operator must show; at least 8 characters of [A-Za-z0-9_-].
    std::string title;                  ///< Shown on the page: "explore_and_return in unb_case1".
    double hull_diameter_m = 0.55;
    double command_timeout_s = 2.0;  ///< How long an answer waits for the CommandResult.
    double stall_timeout_s = 10.0;   ///< A stream's client that takes nothing for so long is dropped.
    int max_connections = 256;
    /// The time now since 1970; for the age of frames only. Called from the thread that runs the IoContext.
    std::function<common::Time()> unix_time;
  };

  /// Where telemetry comes from and commands go to; all must outlive IoContext::run(). Commands carry ids that rise
  /// from 1; each result in `results` answers the command with its id.
  struct Sources {
    const common::LatestValue<common::World>& world;
    const common::LatestValue<common::CameraFrame>& camera;
    common::LosslessQueue<common::OperatorCommand>& commands;
    common::LosslessQueue<common::CommandResult>& results;
  };

  /// Listens at once. Throws common::InputError when the address cannot be used or the port is taken.
  WebServer(IoContext& io, const Options& options, const Sources& sources);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// The port it listens on.
  int port() const;
  /// "http://127.0.0.1:8080/?token=...": what to open. For "0.0.0.0" and "::" with an address of this machine that
  /// others can open, where it has one.
  std::string operatorUrl() const;

  /// Someone watches the camera, so that it is worth rendering. Any thread.
  bool cameraWanted() const;
  /// Shown in the page's list; the last 200 are kept. Any thread.
  void postEvent(const common::Event& event);
  /// Closes all connections; IoContext::run() returns. Any thread, more than once.
  void stop();

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

/// A token of 128 random bits from the operating system.
std::string makeToken();

}  // namespace swiftlet::web
