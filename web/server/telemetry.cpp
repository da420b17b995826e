#include "web/server/telemetry.hpp"

#include <algorithm>
#include <cmath>

#include "common/world/map3d_layer.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"

namespace swiftlet::web {
namespace {

/// Events that a new page gets: more than it shows without scrolling.
constexpr std::size_t kKeptEvents = 200;
/// The real-time factor is that of the last three seconds: steady, and soon right after a pause.
constexpr double kClockWindow_s = 3.0;
/// Denser end points of a scan are not sent: they fall on one pixel of the page.
constexpr double kLaserSpacing_m = 0.04;

/// The scan, thinned for the page.
std::string laserBytes(const common::LaserPoints& laser) {
  std::string bytes(4, '\0');
  Eigen::Vector2f last = Eigen::Vector2f::Constant(1e9f);
  std::size_t count = 0;
  for (const Eigen::Vector2f& p : laser.points_map_m) {
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 320.0f || (p - last).norm() < kLaserSpacing_m) continue;
    last = p;
    for (const float coordinate : {p.x(), p.y()}) {
      const auto cm = static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(100.0f * coordinate)));
      bytes += static_cast<char>(cm & 255);
      bytes += static_cast<char>(cm >> 8);
    }
    if (++count == 2000) break;
  }
  bytes[0] = 2;
  bytes[2] = static_cast<char>(count & 255);
  bytes[3] = static_cast<char>(count >> 8);
  return bytes;
}

}  // namespace

void Telemetry::look() {
  const common::Time at = now();
  if (at < looked_) startAgain(at);
  looked_ = at;
  camera_.look(sources_.camera, at);
  if (!world_.look(sources_.world, at) || !world_.value) return;
  lookAtDepth(at);
  const double unix_s = at.seconds();
  // A world older than the last one belongs to another flight.
  if (!clock_.empty() && world_.value->stamp.seconds() < clock_.back().second) clock_.clear();
  if (clock_.empty() || unix_s - clock_.back().first > 0.05) clock_.emplace_back(unix_s, world_.value->stamp.seconds());
  // The first one that remains is at least as old as the window, so that after a pause there is still a world to
  // compare with.
  while (clock_.size() > 2 && unix_s - clock_[1].first > kClockWindow_s) clock_.pop_front();
}

/// After the clock was set back: seen values count as seen now, and age from now on.
void Telemetry::startAgain(common::Time at) {
  clock_.clear();
  camera_.unix_time = world_.unix_time = depth_.unix_time = at;
}

void Telemetry::lookAtDepth(common::Time at) {
  const auto& map3d = world_.value->map3d;
  const auto newest = map3d ? map3d->frame : nullptr;
  if (depth_.sequence > 0 && newest == depth_.value) return;
  ++depth_.sequence;
  depth_.value = newest;
  depth_.unix_time = at;
}

Observation Telemetry::observe() const {
  Observation seen;
  const common::Time at = now();
  seen.sequence = world_.sequence;
  if (world_.value) seen.world_age_s = (at - world_.unix_time).seconds();
  if (camera_.value) seen.camera_age_s = (at - camera_.unix_time).seconds();
  if (depth_.value) seen.depth_age_s = (at - depth_.unix_time).seconds();
  if (clock_.size() >= 2 && clock_.back().first - clock_.front().first > 0.5)
    seen.realtime_factor =
        (clock_.back().second - clock_.front().second) / (clock_.back().first - clock_.front().first);
  return seen;
}

void Telemetry::followTrail() {
  const common::Trail& next = world_.value->vehicle->trail;
  if (!next.continues(trail_)) ++trail_version_;
  trail_ = next;
}

void Telemetry::encodeParts() {
  if (!world_.value) return;
  state_ = std::make_shared<const std::string>(stateJson(*world_.value, observe()));
  if (world_.sequence == encoded_sequence_) return;
  encoded_sequence_ = world_.sequence;
  encodeMap(*world_.value->map);
  if (encoded_mission_ != world_.value->mission) tree_.update(world_.value->mission->status.tree);
  encoded_mission_ = world_.value->mission;
  const auto& laser = world_.value->vehicle->laser;
  if (laser && encoded_laser_ != laser) laser_.set(laserBytes(*laser));
  encoded_laser_ = laser;
  followTrail();
}

void Telemetry::encodeMap(const common::MapLayer& map) {
  if (!encoded_map_ || encoded_map_->frontiers != map.frontiers)
    frontiers_.set(frontiersJson(*map.frontiers, map.grid->resolution_m()));
  if (!encoded_map_ || encoded_map_->levels != map.levels) levels_.set(levelsJson(*map.levels));
  tiles_.update(map.flown);
  if (!encoded_map_ || encoded_map_->given != map.given) given_map_.set(givenMapJson(map.given.get()));
  if (map.given) given_tiles_.update(map.given->grid);
  encoded_map_ = world_.value->map;
}

void Telemetry::encodeMap3d() {
  if (world_.value && world_.value->map3d) submaps_.update(*world_.value->map3d);
}

void Telemetry::postEvent(const common::Event& event) {
  const std::scoped_lock lock(events_mutex_);
  events_.push_back({++event_count_, event});
  if (events_.size() > kKeptEvents) events_.pop_front();
}

std::vector<NumberedEvent> Telemetry::eventsAfter(std::uint64_t number) const {
  const std::scoped_lock lock(events_mutex_);
  const auto first = std::find_if(events_.begin(), events_.end(),
                                  [number](const NumberedEvent& event) { return event.number > number; });
  return {first, events_.end()};
}

}  // namespace swiftlet::web
