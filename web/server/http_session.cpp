#include "web/server/http_session.hpp"

#include <algorithm>
#include <optional>

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <nlohmann/json.hpp>

#include "web/server/assets.hpp"
#include "web/server/map3d_session.hpp"
#include "web/server/mission_shelf.hpp"
#include "web/server/page_session.hpp"
#include "web/server/stream_session.hpp"

namespace swiftlet::web {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;
using common::Message;
using Response = http::response<http::string_body>;

/// Limits against clients that send without end. The longest command has some hundred bytes.
constexpr std::uint32_t kMostHeaderBytes = 8 * 1024;
constexpr std::uint64_t kMostBodyBytes = std::uint64_t{4} * 1024;
constexpr auto kRequestTimeout = std::chrono::seconds(15);

/// Security headers: nothing is loaded from elsewhere, no other page may frame this one (a click on Land must be
/// meant), and the token in the address is not passed on.
constexpr const char* kContentPolicy =
    "default-src 'self'; img-src 'self' blob: data:; connect-src 'self' ws: wss:; frame-ancestors 'none'; "
    "base-uri 'none'; form-action 'none'";

std::string text(beast::string_view view) { return {view.data(), view.size()}; }

/// A proxy without WebSocket settings drops Upgrade and Connection from a handshake and passes the rest on, perhaps by
/// HTTP/1.0. nginx makes a tunnel nevertheless if the answer is 101. The key shows the intent: no script can set a
/// header Sec-.
void completeHandshake(http::request<http::string_body>& request) {
  if (request.method() != http::verb::get || request[http::field::sec_websocket_key].empty()) return;
  request.version(11);
  request.set(http::field::connection, "Upgrade");
  request.set(http::field::upgrade, "websocket");
}

class HttpSession : public Connection, public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(std::shared_ptr<Core> core, boost::asio::ip::tcp::socket socket)
      : Connection(Use::kRequests, false),
        core_(std::move(core)),
        stream_(std::move(socket)),
        buffer_(kMostHeaderBytes + kMostBodyBytes) {}

  void start() {
    core_->add(shared_from_this());
    read();
  }

  void close() override {
    error_code ignored;
    if (stream_.socket().is_open()) stream_.socket().close(ignored);
  }

 private:
  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeaderBytes);
    parser_->body_limit(kMostBodyBytes);
    stream_.expires_after(kRequestTimeout);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](const error_code& error, std::size_t) { self->onRead(error); });
  }

  void onRead(const error_code& error) {
    if (core_->closed()) return close();
    if (error == http::error::end_of_stream || error == beast::error::timeout) return close();
    keep_alive_ = false;
    head_only_ = false;
    if (error == http::error::body_limit)
      return sendError(413, Message("request.body-too-large", "the body is too large"));
    if (error == http::error::header_limit || error == http::error::buffer_overflow)
      return sendError(431, Message("request.headers-too-large", "the headers are too large"));
    if (error && error.category() == http::make_error_code(http::error::bad_method).category())
      return sendError(400, Message("request.no-http", "this is not an HTTP request: {}", error.message()));
    if (error) return close();
    request_ = parser_->release();
    keep_alive_ = request_.version() >= 11 && request_.keep_alive();
    head_only_ = request_.method() == http::verb::head;
    act();
  }

  void act() {
    Request request;
    request.method = text(request_.method_string());
    request.target = text(request_.target());
    request.host = text(request_[http::field::host]);
    // Proxies that speak HTTP/1.0 may send no Host. Browsers do, so DNS rebinding is still refused.
    if (request_.version() < 11 && request_.count(http::field::host) == 0) request.host = "localhost";
    completeHandshake(request_);
    request.origin = text(request_[http::field::origin]);
    request.authorization = text(request_[http::field::authorization]);
    request.token = text(request_["X-Swiftlet-Token"]);
    request.body = request_.body();
    request.wants_websocket = beast::websocket::is_upgrade(request_);
    setByOperator(hasToken(request, core_->policy));  // A proxy sends the requests of many by one connection.
    std::visit([this](const auto& action) { perform(action); }, route(request, core_->policy));
  }

  void perform(const Refuse& refuse) {
    Response response = refusal(refuse.status, refuse.reason);
    if (!refuse.allow.empty()) response.set(http::field::allow, refuse.allow);
    if (refuse.status == 401) response.set(http::field::www_authenticate, "Bearer");
    send(std::move(response));
  }

  void perform(const ServeFile& file) {
    const auto all = assets();
    const auto asset = std::find_if(all.begin(), all.end(), [&](const Asset& a) { return a.name == file.name; });
    Response response = make(200, {asset->media_type.data(), asset->media_type.size()});
    response.set(http::field::etag, beast::string_view(asset->tag.data(), asset->tag.size()));
    response.set(http::field::cache_control, "no-cache");
    response.set("Content-Security-Policy", kContentPolicy);
    if (text(request_[http::field::if_none_match]) == asset->tag)
      response.result(http::status::not_modified);
    else
      response.body() = asset->content;
    send(std::move(response));
  }

  void perform(const Redirect& redirect) {
    Response response = make(307, "text/plain");
    response.set(http::field::location, redirect.location);
    send(std::move(response));
  }

  void perform(const StreamPictures& stream) {
    if (!mayWatch()) return;
    startStream(core_, stream_.release_socket(), stream, byOperator());
  }

  void perform(const SendPicture& picture) {
    WatchedVehicle& vehicle = core_->vehicle(picture.vehicle);
    vehicle.telemetry.look();
    if (!vehicle.telemetry.world().value) return sendError(503, Message("server.no-map", "there is no map yet"));
    if (!core_->mayDraw(*this) || (!byOperator() && !core_->viewersMaySend()))
      return sendError(503, Message("server.busy", "too many viewers; try again"));
    const common::Time begin = core_->now();
    const std::vector<std::uint8_t> png = vehicle.hub.png(picture.view);
    core_->drew(*this, core_->now() - begin);
    Response response = make(200, "image/png");
    response.body().assign(png.begin(), png.end());
    core_->sent(*this, png.size());
    send(std::move(response));
  }

  void perform(const SendState& state) {
    Telemetry& telemetry = core_->vehicle(state.vehicle).telemetry;
    telemetry.look();
    if (!telemetry.world().value) return sendError(503, Message("server.no-state", "there is no state yet"));
    Response response = make(200, "application/json");
    response.body() = completeJson(*telemetry.world().value, telemetry.observe(), telemetry.events().after(0));
    send(std::move(response));
  }

  void perform(const OpenSocket& socket) {
    if (!mayWatch()) return;
    if (socket.feed == OpenSocket::Feed::kMap3d)
      startMap3d(core_, socket.vehicle, stream_.release_socket(), request_, byOperator());
    else
      startPage(core_, socket.vehicle, stream_.release_socket(), request_, byOperator());
  }

  /// Sends an error to the client if it may not.
  bool mayWatch() {
    const bool may = byOperator() || core_->roomForViewer();
    if (!may)
      sendError(503,
                Message("server.too-many-viewers", "too many viewers; close some pages, or use the operator's link"));
    return may;
  }

  void perform(const ConfirmToken&) { send(json(200, {{"accepted", true}, {"reason", ""}})); }

  void perform(const ListMissions&) {
    Response response = make(200, "application/json");
    response.body() = core_->options.missions == nullptr ? "[]" : core_->options.missions->list();
    send(std::move(response));
  }

  void perform(const StartMission& start) {
    if (core_->options.missions == nullptr)
      return sendError(404, Message("server.no-missions", "this program offers no missions"));
    auto taken = core_->options.missions->take(start.file, start.parameters);
    if (!taken) return sendError(409, Message("mission.not-flown", "{}", taken.error()));
    perform(GiveCommand{std::move(*taken), start.vehicle});
  }

  void perform(const GiveCommand& command) {
    const bool given =
        core_->vehicle(command.vehicle)
            .desk.give(command.kind, [self = shared_from_this()](std::uint64_t id,
                                                                 const std::optional<common::CommandResult>& result) {
              self->answer(id, result);
            });
    if (!given) return sendError(503, Message("server.too-many-commands", "too many commands wait for their answer"));
    stream_.expires_never();
    core_->wake();
  }

  void answer(std::uint64_t id, const std::optional<common::CommandResult>& result) {
    if (!stream_.socket().is_open()) return;
    if (!result) {
      send(json(
          504, {{"id", id}, {"accepted", false}, {"reason", "no answer in time; the vehicle may still carry it out"}}));
    } else {
      send(
          json(result->accepted ? 200 : 409, {{"id", id}, {"accepted", result->accepted}, {"reason", result->reason}}));
    }
  }

  Response make(int status, beast::string_view media_type) const {
    Response response(static_cast<http::status>(status), 11);
    response.set(http::field::content_type, media_type);
    response.set(http::field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    return response;
  }

  Response json(int status, const nlohmann::ordered_json& body) const {
    Response response = make(status, "application/json");
    response.body() = body.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    return response;
  }

  Response refusal(int status, const Message& why) const {
    return json(status, {{"accepted", false}, {"code", why.name()}, {"reason", why.text()}});
  }
  void sendError(int status, const Message& why) { send(refusal(status, why)); }

  void send(Response response) {
    response.keep_alive(keep_alive_);
    response.prepare_payload();
    if (head_only_) response.body().clear();  // Content-Length stays that of the answer to GET.
    auto shared = std::make_shared<Response>(std::move(response));
    stream_.expires_after(kRequestTimeout);
    http::async_write(stream_, *shared, [self = shared_from_this(), shared](const error_code& error, std::size_t) {
      if (error || self->core_->closed()) return self->close();
      if (shared->keep_alive()) return self->read();
      self->finish();
    });
  }

  /// Shuts down sending and waits for the client to close. If the socket were closed with unread bytes, the kernel
  /// would discard the answer.
  void finish() {
    error_code ignored;
    stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
    drain(16);
  }

  void drain(int reads_left) {
    if (reads_left == 0) return close();
    buffer_.clear();
    stream_.expires_after(std::chrono::seconds(2));
    stream_.async_read_some(buffer_.prepare(4096),
                            [self = shared_from_this(), reads_left](const error_code& error, std::size_t) {
                              if (error) return self->close();
                              self->drain(reads_left - 1);
                            });
  }

  std::shared_ptr<Core> core_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::request<http::string_body> request_;
  bool keep_alive_ = false;
  bool head_only_ = false;
};

}  // namespace

void startHttp(std::shared_ptr<Core> core, boost::asio::ip::tcp::socket socket) {
  std::make_shared<HttpSession>(std::move(core), std::move(socket))->start();
}

}  // namespace swiftlet::web
