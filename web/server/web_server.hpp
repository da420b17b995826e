// The operator's page, its live state and the picture streams, over HTTP and WebSocket. It reads telemetry and hands
// over commands; it cannot delay or change anything in the flight.
//
//   GET  /                        the page, embedded in the program; no other host is needed
//   GET  /stream/map.mjpg         ?width= &height= &fps= &scheme=light|dark; multipart/x-mixed-replace
//   GET  /stream/camera.mjpg      ?width= &fps=
//   GET  /stream/map3d.mjpg       ?width= &height= &fps= &scheme= &color=measured|normal, and from where it is seen:
//                                 &view=whole   &azimuth= &elevation=                   (when no view is given)
//                                 &view=orbit   &x= &y= &z= &distance= &azimuth= &elevation=
//                                 &view=follow  &distance= &azimuth= &elevation=        around the vehicle
//                                 &view=camera                                          as the RGB-D camera sees
//                                 x, y, z in metres of `map`; distance 0.2 to 1000 m; azimuth -360 to 360 degrees
//                                 from the x axis; elevation -89 to 89 degrees above the horizon
//   GET  /stream/depth.mjpg       ?width= &fps=; depth in colours, see rendering/depth_picture.hpp
//   GET  /api/state               everything as one JSON document
//   GET  /api/map.png             the picture of the map; ?width= &height= &scheme=
//   GET  /api/ws                  WebSocket: the content of /api/state in parts, only changes, and the map's tiles
//   GET  /api/map3d               WebSocket: the points of the 3D map and their poses, see web/server/submap_feed.hpp
//   GET  /api/missions            the missions that may be started, with their parameters; with the token
//   POST /api/mission             starts one, or another in its place: {"file": "...", "parameters": {"KEY": "VALUE"}}
//   POST /api/stop                the mission releases control; the vehicle holds until one is started, or it lands
//   GET  /api/token               200 if the token shown is the operator's, else 401
//   POST /api/goal|hold|resume|home|land|keep_out|clear_keep_out|go_on
//                                 with the token: `Authorization: Bearer TOKEN`, `X-Swiftlet-Token: TOKEN` or
//                                 ?token=TOKEN; goal: {"x_m": 1.0, "y_m": 2.0}; keep_out: see
//                                 docs/tutorials/operator.md
//
// Where several vehicles fly, ?vehicle=NAME says which one is meant, everywhere; without it the first.
//
// Viewers (without the token) share bounded slots and bandwidth; operators come before them. A stream or a socket is
// the operator's with ?token=.
//
// Streams: a picture is encoded once for all clients that asked for the same; each client has at most one frame under
// way and gets the newest when it is ready again, so that a slow client delays no other, and its own picture
// is never older than one frame. Requests whose Host is neither an address nor a name of this machine or of a public
// URL, or whose Origin is foreign, are refused (no DNS rebinding, no CSRF).
//
// A proxy may stand in front: by HTTP/1.0 or 1.1, with the Host or with another one, below a path that it takes off or
// leaves on. X-Forwarded-* is ignored, because any client can send it: the public URLs define the outside addresses.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/event.hpp"
#include "web/server/io_context.hpp"
#include "web/server/web_server_options.hpp"

namespace swiftlet::web {

class WebServer {
 public:
  using Options = WebServerOptions;
  using Sources = WebServerSources;

  /// Starts to listen at once. Throws common::InputError if the address cannot be used, the port is taken or a public
  /// URL is invalid.
  WebServer(IoContext& io, const Options& options, const Sources& sources);
  /// Serves several vehicles: one of `sources` each, at least one. If there are several, each must have a name.
  WebServer(IoContext& io, const Options& options, const std::vector<Sources>& sources);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// The port it listens on.
  int port() const;
  /// The links to open. The first is "http://127.0.0.1:8080/?token=..."; for "0.0.0.0" and "::" it has an address of
  /// this machine that others can open, if there is one. Those of the public URLs follow.
  std::vector<std::string> operatorUrls() const;

  /// Whether any client watches the vehicle's camera. Otherwise it need not be rendered. Any thread.
  bool cameraWanted(std::size_t vehicle = 0) const;
  /// Shown in the list of the vehicle's page; the last 200 are kept. Any thread.
  void postEvent(const common::Event& event, std::size_t vehicle = 0);
  /// Closes all connections; IoContext::run() returns. Any thread, more than once.
  void stop();

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

/// A token of 128 random bits from the operating system.
std::string makeToken();

}  // namespace swiftlet::web
