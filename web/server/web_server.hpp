// The operator's page, its live state and the picture streams, over HTTP and WebSocket. It reads telemetry and hands
// over commands; it cannot delay or change anything in the flight.
//
//   GET  /                        the page, embedded in the program; no other host is needed
//   GET  /stream/map.mjpg         ?width= &height= &fps= &scheme=light|dark; multipart/x-mixed-replace
//   GET  /stream/camera.mjpg      ?width= &fps=
//   GET  /api/state               everything as one JSON document
//   GET  /api/map.png             the picture of the map; ?width= &height= &scheme=
//   GET  /api/ws                  WebSocket: the content of /api/state in parts, only changes, and the map's tiles
//   POST /api/goal|hold|resume|home|land    `Authorization: Bearer TOKEN` or ?token=; goal: {"x_m": 1.0, "y_m": 2.0}
//
// Streams: a picture is encoded once for all clients that asked for the same view. At most one frame is being sent to a
// client, and the next one is the newest. So a slow client does not delay the others, and its own picture is never
// older than one frame. A request is refused if its Host is neither an address nor a name of this machine, or if its
// Origin is foreign (against DNS rebinding and CSRF).
#pragma once

#include <memory>
#include <string>

#include "common/event.hpp"
#include "web/server/io_context.hpp"
#include "web/server/web_server_options.hpp"

namespace swiftlet::web {

class WebServer {
 public:
  using Options = WebServerOptions;
  using Sources = WebServerSources;

  /// Starts to listen at once. Throws common::InputError if the address cannot be used or the port is taken.
  WebServer(IoContext& io, const Options& options, const Sources& sources);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// The port it listens on.
  int port() const;
  /// The link to open: "http://127.0.0.1:8080/?token=...". For "0.0.0.0" and "::" it has an address of this machine
  /// that others can open, if there is one.
  std::string operatorUrl() const;

  /// A page shows the camera, so it must be rendered. Any thread.
  bool cameraWanted() const;
  /// Adds an event to the page's list; the last 200 are kept. Any thread.
  void postEvent(const common::Event& event);
  /// Closes all connections, after which IoContext::run() returns. Any thread; may be called more than once.
  void stop();

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

/// A token of 128 random bits from the operating system.
std::string makeToken();

}  // namespace swiftlet::web
