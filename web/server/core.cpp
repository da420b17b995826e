#include "web/server/core.hpp"

#include <linux/sockios.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cmath>

#include <boost/asio/io_context.hpp>

namespace swiftlet::web {

Core::Core(boost::asio::io_context& io, WebServerOptions options_in, WebServerSources sources, Policy policy_in)
    : options(std::move(options_in)),
      policy(std::move(policy_in)),
      telemetry(sources, options.unix_time),
      hub(telemetry, options.hull_diameter_m),
      desk(sources.commands, sources.results,
           std::max(1, static_cast<int>(std::lround(options.command_timeout_s * kTicksPerSecond)))),
      timer_(io) {}

void Core::add(const std::shared_ptr<Connection>& connection) {
  std::erase_if(connections_, [](const auto& known) { return known.expired(); });
  connections_.push_back(connection);
}

bool Core::full() const {
  const auto alive =
      std::count_if(connections_.begin(), connections_.end(), [](const auto& c) { return !c.expired(); });
  return alive >= options.max_connections;
}

void Core::watch(const std::shared_ptr<Connection>& connection) {
  watchers_.push_back(connection);
  telemetry.look();
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
  telemetry.look();
  desk.tick();
  std::erase_if(watchers_, [](const auto& watcher) { return watcher.expired(); });
  const common::Time now = telemetry.now();
  // A watcher may close, or a new one come, during these calls.
  for (const std::weak_ptr<Connection>& weak : std::vector(watchers_))
    if (const auto watcher = weak.lock()) watcher->tick(now);
  // Without watchers it still looks now and then, so that a new watcher learns the real-time factor at once.
  ticking_ = !watchers_.empty() || desk.waiting();
  timer_.expires_after(std::chrono::milliseconds(1000 / (ticking_ ? kTicksPerSecond : kIdleTicksPerSecond)));
  schedule();
}

void Core::close() {
  closed_ = true;
  timer_.cancel();
  for (const std::weak_ptr<Connection>& weak : std::exchange(connections_, {}))
    if (const auto connection = weak.lock()) connection->close();
  watchers_.clear();
  // A waiting session and the desk refer to each other; answering that nothing comes releases both.
  while (desk.waiting()) desk.tick();
}

int unsentBytes(int native_socket) {
  int waiting = 0;
  return ioctl(native_socket, SIOCOUTQ, &waiting) == 0 ? waiting : 0;
}

}  // namespace swiftlet::web
