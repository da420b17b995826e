// Groot2 beside the flight: the thread that answers it, and the mailbox between it and the loop.
#pragma once

#include <string>
#include <thread>

#include "autonomy/loop/flight_sink.hpp"
#include "behaviors/tree/registry.hpp"
#include "common/mailbox.hpp"
#include "interfaces/links/groot/groot_server.hpp"

namespace swiftlet::flight {

/// Shows the tree of one vehicle. It is asked and answers; it cannot delay or change anything in the flight.
class GrootLink {
 public:
  /// Listens at once; throws common::InputError when it cannot.
  GrootLink(const std::string& address, int port, const tree::Registry& types);

  int port() const { return server_.port(); }
  common::LatestValue<common::World>& world() { return world_; }

 private:
  void answer(const std::string& models, const std::stop_token& stop);

  common::LatestValue<common::World> world_;
  interfaces::GrootServer server_;
  std::jthread thread_;
};

class GrootSink final : public autonomy::FlightSink {
 public:
  explicit GrootSink(GrootLink& groot) : groot_(groot) {}
  void world(const std::shared_ptr<const common::World>& world) override { groot_.world().post(world); }

 private:
  GrootLink& groot_;
};

}  // namespace swiftlet::flight
