// The server's view of the flight: the newest world and camera frame with the time they were seen, the parts of the
// world encoded once for all pages, the events. Use it on the thread of the event loop only, except postEvent().
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/rgbd_frame.hpp"
#include "common/world.hpp"
#include "common/world/vehicle_layer.hpp"
#include "web/server/state_json.hpp"
#include "web/server/submap_feed.hpp"
#include "web/server/tile_feed.hpp"
#include "web/server/tree_feed.hpp"
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

/// A text for the pages with a number that rises when it changes.
struct Part {
  SharedText text;
  std::uint64_t version = 0;

  void set(std::string next) {
    if (text && *text == next) return;
    text = std::make_shared<const std::string>(std::move(next));
    ++version;
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

  /// encodeParts(), which a page's tick calls, updates the parts below; null before the first world.
  void encodeParts();
  const SharedText& state() const { return state_; }
  const Part& frontiers() const { return frontiers_; }
  const Part& levels() const { return levels_; }
  /// The map of this flight alone.
  const TileFeed& tiles() const { return tiles_; }
  /// The given map, in its own cells; empty without one.
  const TileFeed& givenTiles() const { return given_tiles_; }
  const Part& givenMap() const { return given_map_; }
  const TreeFeed& tree() const { return tree_; }
  /// encodeMap3d(), which the tick of a page with a 3D view calls, updates it.
  void encodeMap3d();
  const SubmapFeed& submaps() const { return submaps_; }
  /// Little endian: u8 2, u8 0, u16 number of points, then i16 x, i16 y in centimetres; null: no scan.
  const Part& laser() const { return laser_; }
  /// Rises if earlier points of the trail have moved.
  std::uint64_t trailVersion() const { return trail_version_; }

  void postEvent(const common::Event& event);
  /// The events after `number`, oldest first.
  std::vector<NumberedEvent> eventsAfter(std::uint64_t number) const;

 private:
  void startAgain(common::Time at);
  void lookAtDepth(common::Time at);
  void encodeMap(const common::MapLayer& map);
  void followTrail();

  WebServer::Sources sources_;
  std::function<common::Time()> unix_time_;
  common::Time looked_;  ///< The last time that look() was called.
  Seen<common::World> world_;
  Seen<common::CameraFrame> camera_;
  Seen<common::RgbdFrame> depth_;
  /// (unix, simulated) seconds of the recent worlds.
  std::deque<std::pair<double, double>> clock_;

  std::uint64_t encoded_sequence_ = 0;
  SharedText state_;
  Part frontiers_, levels_, laser_, given_map_;
  std::shared_ptr<const common::MapLayer> encoded_map_;
  std::shared_ptr<const common::LaserPoints> encoded_laser_;
  TileFeed tiles_, given_tiles_;
  TreeFeed tree_;
  std::shared_ptr<const common::MissionLayer> encoded_mission_;
  SubmapFeed submaps_;
  common::Trail trail_;
  std::uint64_t trail_version_ = 1;

  mutable std::mutex events_mutex_;
  std::deque<NumberedEvent> events_;
  std::uint64_t event_count_ = 0;
};

}  // namespace swiftlet::web
