#include "web/server/core.hpp"

#include <linux/sockios.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cmath>

#include <boost/asio/io_context.hpp>

namespace swiftlet::web {
namespace {

/// Without watchers and without pending answers.
constexpr int kIdleTicksPerSecond = 4;
/// Connections at the same time that only send requests; a browser opens six.
constexpr std::ptrdiff_t kMostForRequests = 64;
/// Viewers may save this much of their bandwidth, for a map or a picture at once.
constexpr double kSavedBandwidth_s = 0.25;
/// Share of the thread's time in which pictures are drawn for viewers. The operator's pictures take half of it at most
/// (FrameHub), which leaves a quarter for everything else.
constexpr double kViewersShareOfThread = 0.25;
/// Time for drawing that viewers may save: about two pictures of the greatest size.
constexpr double kSavedDrawing_s = 0.25;

/// The clock may have been set, so times are bounded.
double boundedSeconds(common::Duration time, double most_s) { return std::clamp(time.seconds(), 0.0, most_s); }

}  // namespace

WatchedVehicle::WatchedVehicle(const WebServerOptions& options, const WebServerSources& sources)
    : name(sources.name),
      telemetry(sources, options.unix_time),
      hub(telemetry, options.hull_diameter_m),
      desk(sources.commands, sources.results,
           std::max(1, static_cast<int>(std::lround(options.command_timeout_s * kTicksPerSecond)))) {}

Core::Core(boost::asio::io_context& io, WebServerOptions options_in, const std::vector<WebServerSources>& sources,
           Policy policy_in)
    : options(std::move(options_in)),
      policy(std::move(policy_in)),
      timer_(io),
      viewer_credit_bytes_(kSavedBandwidth_s * options.viewers_bytes_per_s),
      viewer_credit_s_(kSavedDrawing_s) {
  for (const WebServerSources& vehicle : sources)
    vehicles_.push_back(std::make_unique<WatchedVehicle>(options, vehicle));
}

void Core::add(const std::shared_ptr<Connection>& connection) {
  std::erase_if(connections_, [](const auto& known) { return known.expired(); });
  connections_.push_back(connection);
  const auto asks = [](const auto& known) {
    const auto alive = known.lock();
    return alive && !alive->watches() && !alive->byOperator();
  };
  if (std::count_if(connections_.begin(), connections_.end(), asks) <= kMostForRequests) return;
  const auto oldest = std::find_if(connections_.begin(), connections_.end(), asks);
  const auto closing = oldest->lock();
  connections_.erase(oldest);
  closing->close();
}

bool Core::roomForViewer() const {
  const auto viewers = std::count_if(connections_.begin(), connections_.end(), [](const auto& known) {
    const auto alive = known.lock();
    return alive && alive->watches() && !alive->byOperator();
  });
  return viewers < options.max_connections;
}

void Core::sent(const Connection& to, std::size_t bytes) {
  if (!to.byOperator()) viewer_credit_bytes_ -= static_cast<double>(bytes);
}

/// Wakes the ticks, with which the next viewer may be drawn for.
void Core::drew(const Connection& to, common::Duration time) {
  if (to.byOperator()) return;
  viewer_credit_s_ -= boundedSeconds(time, 1.0);
  drew_for_viewer_ = true;
  wake();
}

void Core::refill(common::Time now) {
  const double elapsed_s = boundedSeconds(now - refilled_, kSavedBandwidth_s);
  refilled_ = now;
  viewer_credit_s_ = std::min(viewer_credit_s_ + elapsed_s * kViewersShareOfThread, kSavedDrawing_s);
  drew_for_viewer_ = false;
  const double rate = options.viewers_bytes_per_s;
  viewer_credit_bytes_ = std::min(viewer_credit_bytes_ + elapsed_s * rate, kSavedBandwidth_s * rate);
}

void Core::watch(const std::shared_ptr<Connection>& connection) {
  watchers_.push_back(connection);
  for (const auto& vehicle : vehicles_) vehicle->telemetry.look();
  wake();
}

void Core::wake() {
  if (ticking_ || closed_) return;
  ticking_ = true;
  timer_.expires_after(std::chrono::milliseconds(0));
  schedule();
}

void Core::schedule() {
  timer_.async_wait([self = shared_from_this()](const boost::system::error_code& error) {
    if (error || self->closed_) return;
    self->tick();
  });
}

void Core::tick() {
  for (const auto& vehicle : vehicles_) {
    vehicle->telemetry.look();
    vehicle->desk.tick();
  }
  std::erase_if(watchers_, [](const auto& watcher) { return watcher.expired(); });
  tickWatchers(now());
  // Without watchers it still ticks now and then, so that a new one learns at once how fast time passes.
  ticking_ = !watchers_.empty() || anyWaiting();
  timer_.expires_after(std::chrono::milliseconds(1000 / (ticking_ ? kTicksPerSecond : kIdleTicksPerSecond)));
  schedule();
}

/// The operators first, then the viewers in turn until their bandwidth is used up; the turn continues behind the one
/// that was drawn for. A watcher may close during its call, and another may come.
void Core::tickWatchers(common::Time now) {
  refill(now);
  std::vector<std::shared_ptr<Connection>> viewers;
  for (const std::weak_ptr<Connection>& weak : std::vector(watchers_)) {
    auto watcher = weak.lock();
    if (!watcher) continue;
    if (watcher->byOperator())
      watcher->tick(now);
    else
      viewers.push_back(std::move(watcher));
  }
  std::size_t next = first_viewer_;
  for (std::size_t i = 0; i < viewers.size() && viewersMaySend(); ++i) {
    const bool drew_before = drew_for_viewer_;
    viewers[next++ % viewers.size()]->tick(now);
    if (drew_for_viewer_ && !drew_before) first_viewer_ = next;
  }
  if (!drew_for_viewer_) first_viewer_ = next;
}

void Core::close() {
  closed_ = true;
  timer_.cancel();
  for (const std::weak_ptr<Connection>& weak : std::exchange(connections_, {}))
    if (const auto connection = weak.lock()) connection->close();
  watchers_.clear();
  // A pending request and this object own each other through the desk. The last ticks answer all of them, which ends
  // that cycle.
  for (const auto& vehicle : vehicles_)
    while (vehicle->desk.waiting()) vehicle->desk.tick();
}

bool Core::anyWaiting() const {
  return std::any_of(vehicles_.begin(), vehicles_.end(), [](const auto& vehicle) { return vehicle->desk.waiting(); });
}

int unsentBytes(int native_socket) {
  int waiting = 0;
  return ioctl(native_socket, SIOCOUTQ, &waiting) == 0 ? waiting : 0;
}

}  // namespace swiftlet::web
