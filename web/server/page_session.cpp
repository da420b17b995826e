#include "web/server/page_session.hpp"

#include <deque>

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket.hpp>

namespace swiftlet::web {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;

/// The page moves smoothly at 10 Hz. The map may lag a little more, as its tiles are most of the traffic.
constexpr double kStatesPerSecond = 10.0;
constexpr double kMapsPerSecond = 4.0;
/// Of one message, so that a state waits for at most 64 KiB of map on a slow link.
constexpr std::size_t kMostTileBytes = std::size_t{64} * 1024;

class PageSession : public Connection, public std::enable_shared_from_this<PageSession> {
 public:
  PageSession(std::shared_ptr<Core> core, std::size_t vehicle, boost::asio::ip::tcp::socket socket, bool by_operator)
      : Connection(Use::kWatching, by_operator),
        core_(std::move(core)),
        vehicle_(core_->vehicle(vehicle)),
        stream_(std::move(socket)) {}

  void start(const beast::http::request<beast::http::string_body>& upgrade) {
    error_code ignored;
    tcp().set_option(boost::asio::ip::tcp::no_delay(true), ignored);
    tcp().set_option(boost::asio::socket_base::send_buffer_size(kSendBufferBytes), ignored);
    beast::get_lowest_layer(stream_).expires_never();
    websocket::stream_base::timeout timeout;
    timeout.handshake_timeout = std::chrono::seconds(10);
    timeout.idle_timeout = std::chrono::seconds(20);
    timeout.keep_alive_pings = true;
    stream_.set_option(timeout);
    stream_.read_message_max(1024);
    core_->add(shared_from_this());
    stream_.async_accept(upgrade, [self = shared_from_this()](const error_code& error) {
      if (error || self->core_->closed()) return;
      self->open_ = true;
      const Core& core = *self->core_;
      self->queueText(
          helloJson(core.options.title, core.options.hull_diameter_m, core.policy.vehicles, self->vehicle_.name));
      self->core_->watch(self);
      self->read();
    });
  }

  void close() override {
    open_ = false;
    error_code ignored;
    tcp().close(ignored);
  }

  void tick(common::Time now) override {
    if (!open_ || writing_ || !state_beat_.due(now) || unsentBytes(tcp().native_handle()) > kMostUnsentBytes) return;
    state_beat_.done(now);
    collect(now);
    writeNext();
  }

 private:
  struct Message {
    SharedText text;
    bool binary;
  };

  boost::asio::ip::tcp::socket& tcp() { return beast::get_lowest_layer(stream_).socket(); }

  void queueText(std::string text) { queue_.push_back({std::make_shared<const std::string>(std::move(text)), false}); }

  void queuePart(const Part& part, std::uint64_t& has, bool binary) {
    if (part.version == has || !part.text) return;
    has = part.version;
    queue_.push_back({part.text, binary});
  }

  void collect(common::Time now) {
    Telemetry& telemetry = vehicle_.telemetry;
    telemetry.encodeParts();
    if (const auto events = telemetry.eventsAfter(last_event_); !events.empty()) {
      last_event_ = events.back().number;
      queueText(eventsJson(events));
    }
    if (!telemetry.world().value) return;
    if (map_beat_.due(now)) {
      map_beat_.done(now);
      std::string tiles = tiles_.next(telemetry.tiles(), kMostTileBytes);
      if (!tiles.empty()) queue_.push_back({std::make_shared<const std::string>(std::move(tiles)), true});
    }
    queuePart(telemetry.levels(), levels_version_, false);
    queuePart(telemetry.frontiers(), frontiers_version_, false);
    collectTrail(telemetry);
    queuePart(telemetry.laser(), laser_version_, true);
    queue_.push_back({telemetry.state(), false});
  }

  void collectTrail(const Telemetry& telemetry) {
    const auto trail = telemetry.world().value->vehicle->trail.points_map_m();
    if (telemetry.trailVersion() != trail_version_) {
      trail_version_ = telemetry.trailVersion();
      trail_sent_ = 0;
    } else if (trail.size() == trail_sent_) {
      return;
    }
    queueText(trailJson(trail, trail_sent_));
    trail_sent_ = trail.size();
  }

  void writeNext() {
    if (queue_.empty() || !open_) {
      writing_ = false;
      return;
    }
    writing_ = true;
    const Message message = queue_.front();
    queue_.pop_front();
    core_->sent(*this, message.text->size());
    stream_.binary(message.binary);
    stream_.async_write(boost::asio::buffer(*message.text),
                        [self = shared_from_this(), message](const error_code& error, std::size_t) {
                          if (error) return self->close();
                          self->writeNext();
                        });
  }

  /// Pages send no messages; reading answers pings and detects the end.
  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](const error_code& error, std::size_t) {
      if (error) return self->close();
      self->buffer_.clear();
      self->read();
    });
  }

  std::shared_ptr<Core> core_;
  WatchedVehicle& vehicle_;
  /// Without compression, which is never asked for and takes as long to compile as all the rest.
  websocket::stream<beast::tcp_stream, false> stream_;
  beast::flat_buffer buffer_;
  std::deque<Message> queue_;
  Beat state_beat_{kStatesPerSecond};
  Beat map_beat_{kMapsPerSecond};
  TileReader tiles_;
  std::uint64_t frontiers_version_ = 0, levels_version_ = 0, laser_version_ = 0, trail_version_ = 0;
  std::size_t trail_sent_ = 0;
  std::uint64_t last_event_ = 0;
  bool open_ = false;
  bool writing_ = false;
};

}  // namespace

void startPage(std::shared_ptr<Core> core, std::size_t vehicle, boost::asio::ip::tcp::socket socket,
               const beast::http::request<beast::http::string_body>& upgrade, bool by_operator) {
  std::make_shared<PageSession>(std::move(core), vehicle, std::move(socket), by_operator)->start(upgrade);
}

}  // namespace swiftlet::web
