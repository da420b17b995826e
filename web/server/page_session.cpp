#include "web/server/page_session.hpp"

#include <span>

#include "common/world/vehicle_layer.hpp"

namespace swiftlet::web {
namespace {

/// The page moves smoothly at 10 Hz. The map may lag a little more, as its tiles are most of the traffic.
constexpr double kStatesPerSecond = 10.0;
constexpr double kMapsPerSecond = 4.0;
/// Of one message, so that a state waits for at most 64 KiB of map on a slow link.
constexpr std::size_t kMostTileBytes = std::size_t{64} * 1024;

class PageSession final : public WebSocket {
 public:
  PageSession(std::shared_ptr<Core> core, std::size_t vehicle, boost::asio::ip::tcp::socket socket, bool by_operator)
      : WebSocket(core, std::move(socket), by_operator, kStatesPerSecond), vehicle_(core->vehicle(vehicle)) {}

 private:
  void opened() override {
    const WebServerOptions& options = core().options;
    queueText(helloJson(options.title, options.hull_diameter_m, core().policy.vehicles, vehicle_.name));
  }

  void queuePart(const Part& part, std::uint64_t& has, bool binary) {
    if (part.version == has || !part.text) return;
    has = part.version;
    queue(part.text, binary);
  }

  void collect(common::Time now) override {
    Telemetry& telemetry = vehicle_.telemetry;
    telemetry.encodeParts();
    if (const auto events = telemetry.events().after(last_event_); !events.empty()) {
      last_event_ = events.back().number;
      queueText(eventsJson(events));
    }
    if (!telemetry.world().value) return;
    const PageParts& parts = telemetry.parts();
    if (map_beat_.due(now)) {
      map_beat_.done(now);
      queueTiles(tiles_.next(parts.tiles(), kMostTileBytes));
      queueTiles(given_tiles_.next(parts.givenTiles(), kMostTileBytes));
    }
    queuePart(parts.givenMap(), given_map_version_, false);
    queuePart(parts.levels(), levels_version_, false);
    queuePart(parts.frontiers(), frontiers_version_, false);
    collectTrail(telemetry.world().value->vehicle->trail.points_map_m(), parts.trailVersion());
    if (parts.tree().version() != tree_version_) {
      queueText(parts.tree().since(tree_version_));
      tree_version_ = parts.tree().version();
    }
    queuePart(parts.laser(), laser_version_, true);
    queue(telemetry.state(), false);
  }

  void queueTiles(std::string tiles) {
    if (!tiles.empty()) queue(std::make_shared<const std::string>(std::move(tiles)), true);
  }

  void collectTrail(std::span<const Eigen::Vector2d> trail, std::uint64_t version) {
    if (version != trail_version_) {
      trail_version_ = version;
      trail_sent_ = 0;
    } else if (trail.size() == trail_sent_) {
      return;
    }
    queueText(trailJson(trail, trail_sent_));
    trail_sent_ = trail.size();
  }

  WatchedVehicle& vehicle_;
  Beat map_beat_{kMapsPerSecond};
  TileReader tiles_{TileReader::Map::kFlown}, given_tiles_{TileReader::Map::kGiven};
  std::uint64_t frontiers_version_ = 0, levels_version_ = 0, laser_version_ = 0, trail_version_ = 0, tree_version_ = 0,
                given_map_version_ = 0;
  std::size_t trail_sent_ = 0;
  std::uint64_t last_event_ = 0;
};

}  // namespace

void startPage(std::shared_ptr<Core> core, std::size_t vehicle, boost::asio::ip::tcp::socket socket,
               const WebSocket::Upgrade& upgrade, bool by_operator) {
  std::make_shared<PageSession>(std::move(core), vehicle, std::move(socket), by_operator)->start(upgrade);
}

}  // namespace swiftlet::web
