#include "simulation/sensors/sensor_streams.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace swiftlet::simulation {

using common::Time;

namespace {

/// A track begins this long before it is needed: more than a physics step, so that it can be interpolated.
constexpr auto kTrackMargin = common::Duration::fromMilliseconds(2);

template <typename Scan>
std::shared_ptr<const Scan> shared(common::LaserScan scan) {
  return std::make_shared<const Scan>(Scan{std::move(scan)});
}

}  // namespace

void LaserStream::step(const Moment& moment, const RayCaster& rays, EventQueue& queue) {
  track_.push_back(moment);
  const Time start = clock_.next(), end = start + scanner_.sweep();
  if (moment.time < end) return;
  common::LaserScan scan = scanner_.scan(clock_.frame, start, track_, rays);
  // The sweep ended between two steps. Nothing arrives before it was computed.
  const std::uint64_t number = clock_.frame++;
  if (sensor_ == Sensor::kVerticalLaser)
    queue.send(sensor_, number, moment.time, shared<common::VerticalScan>(std::move(scan)));
  else
    queue.send(sensor_, number, moment.time, shared<common::LaserScan>(std::move(scan)));
  const Time next = clock_.next();
  const auto first_needed =
      std::find_if(track_.begin(), track_.end() - 1, [next](const Moment& at) { return at.time > next; });
  track_.erase(track_.begin(), first_needed == track_.begin() ? first_needed : first_needed - 1);
}

void CameraStream::step(const Moment& moment, const RayCaster& rays, EventQueue& queue) {
  if (!clock_.due(moment.time)) return;
  const std::uint64_t number = clock_.frame++;
  if (!wanted_) return;
  if (!camera_) camera_.emplace(config_, world_, seed_);
  auto frame = std::make_shared<common::CameraFrame>();
  frame->stamps.measured = moment.time;
  frame->image = camera_->render(number, moment.T_world_body, moment.actors, rays);
  queue.send(Sensor::kCamera, number, moment.time, std::shared_ptr<const common::CameraFrame>(std::move(frame)));
}

// A frame is made when the exposure of its last row has ended; until then the vehicle's track is kept.
void RgbdStream::step(const Moment& moment, const RayCaster& rays, EventQueue& queue) {
  const auto begin = [this] { return clock_.next() - camera_.before() - kTrackMargin; };
  if (moment.time >= begin()) track_.push_back(moment);
  if (moment.time < clock_.next() + camera_.after()) return;
  const std::uint64_t number = clock_.frame;
  auto frame = std::make_shared<common::RgbdFrame>(camera_.frame(number, clock_.next(), track_, rays));
  ++clock_.frame;
  queue.send(Sensor::kRgbd, number, moment.time, std::shared_ptr<const common::RgbdFrame>(std::move(frame)));
  std::erase_if(track_, [next = begin()](const Moment& at) { return at.time < next; });
}

}  // namespace swiftlet::simulation
