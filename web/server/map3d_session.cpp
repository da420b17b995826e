#include "web/server/map3d_session.hpp"

namespace swiftlet::web {
namespace {

/// The camera moves smoothly, and a map of 500,000 points (6 MB) is complete after 5 s on a link that carries it.
constexpr double kBeatsPerSecond = 20.0;
constexpr std::size_t kMostPointBytes = std::size_t{64} * 1024;

class Map3dSession final : public WebSocket {
 public:
  Map3dSession(std::shared_ptr<Core> core, std::size_t vehicle, boost::asio::ip::tcp::socket socket, bool by_operator)
      : WebSocket(core, std::move(socket), by_operator, kBeatsPerSecond), vehicle_(core->vehicle(vehicle)) {}

 private:
  void collect(common::Time now) override {
    vehicle_.telemetry.encodeMap3d();
    for (SharedText& message : reader_.next(vehicle_.telemetry.parts().submaps(), now, kMostPointBytes))
      queue(std::move(message), true);
  }

  WatchedVehicle& vehicle_;
  SubmapReader reader_;
};

}  // namespace

void startMap3d(std::shared_ptr<Core> core, std::size_t vehicle, boost::asio::ip::tcp::socket socket,
                const WebSocket::Upgrade& upgrade, bool by_operator) {
  std::make_shared<Map3dSession>(std::move(core), vehicle, std::move(socket), by_operator)->start(upgrade);
}

}  // namespace swiftlet::web
