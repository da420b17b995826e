#include "web/server/telemetry.hpp"

#include <string>

#include "common/world/map3d_layer.hpp"

namespace swiftlet::web {
namespace {

/// The real-time factor is that of the last three seconds: steady, and soon right after a pause.
constexpr double kClockWindow_s = 3.0;
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

void Telemetry::encodeParts() {
  if (!world_.value) return;
  state_ = std::make_shared<const std::string>(stateJson(*world_.value, observe()));
  parts_.update(world_.value);
}

void Telemetry::encodeMap3d() {
  if (world_.value) parts_.updateMap3d(*world_.value);
}

}  // namespace swiftlet::web
