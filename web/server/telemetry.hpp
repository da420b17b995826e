// The server's view of the flight: the newest world and camera frame with the time they were seen, the parts of the
// world encoded once for all pages, the events. Use it on the thread of the event loop only, except events().
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <utility>

#include "common/rgbd_frame.hpp"
#include "common/world.hpp"
#include "web/server/event_feed.hpp"
#include "web/server/page_parts.hpp"
#include "web/server/state_json.hpp"
#include "web/server/web_server.hpp"

namespace swiftlet::web {

/// The newest value and the time when it was first seen.
template <typename Value>
struct Seen {
  std::shared_ptr<const Value> value;
  std::uint64_t sequence = 0;
  common::Time unix_time;

  bool look(const common::LatestValue<Value>& source, common::Time now) {
    const std::uint64_t newest = source.sequence();
    if (newest == sequence) return false;
    sequence = newest;
    value = source.read();
    unix_time = now;
    return true;
  }
};

class Telemetry {
 public:
  Telemetry(const WebServer::Sources& sources, std::function<common::Time()> unix_time)
      : sources_(sources), unix_time_(std::move(unix_time)) {}

  common::Time now() const { return unix_time_(); }
  /// Checks for new values; cheap without one.
  void look();

  const Seen<common::World>& world() const { return world_; }
  const Seen<common::CameraFrame>& camera() const { return camera_; }
  /// The newest depth image of the RGB-D camera; its number rises with the first world too, which says whether there is
  /// a camera.
  const Seen<common::RgbdFrame>& depth() const { return depth_; }
  Observation observe() const;

  /// encodeParts(), which a page's tick calls, updates the state and the parts; both are empty before the first world.
  void encodeParts();
  /// encodeMap3d(), which the tick of a page with a 3D view calls, updates the submaps of the parts.
  void encodeMap3d();
  const SharedText& state() const { return state_; }
  const PageParts& parts() const { return parts_; }

  /// Any thread may post events.
  EventFeed& events() { return events_; }

 private:
  void startAgain(common::Time at);
  void lookAtDepth(common::Time at);

  WebServer::Sources sources_;
  std::function<common::Time()> unix_time_;
  common::Time looked_;  ///< The last time that look() was called.
  Seen<common::World> world_;
  Seen<common::CameraFrame> camera_;
  Seen<common::RgbdFrame> depth_;
  /// (unix, simulated) seconds of the recent worlds.
  std::deque<std::pair<double, double>> clock_;
  SharedText state_;
  PageParts parts_;
  EventFeed events_;
};

}  // namespace swiftlet::web
