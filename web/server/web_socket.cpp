#include "web/server/web_socket.hpp"

#include <boost/beast/websocket.hpp>

namespace swiftlet::web {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;

WebSocket::WebSocket(std::shared_ptr<Core> core, boost::asio::ip::tcp::socket socket, bool by_operator,
                     double collects_per_second)
    : Connection(Use::kWatching, by_operator),
      core_(std::move(core)),
      stream_(std::move(socket)),
      beat_(collects_per_second) {}

void WebSocket::start(const Upgrade& upgrade) {
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
    self->opened();
    self->core_->watch(self);
    self->read();
  });
}

void WebSocket::close() {
  open_ = false;
  error_code ignored;
  tcp().close(ignored);
}

void WebSocket::tick(common::Time now) {
  if (!open_ || writing_ || !beat_.due(now) || unsentBytes(tcp().native_handle()) > kMostUnsentBytes) return;
  beat_.done(now);
  collect(now);
  writeNext();
}

void WebSocket::writeNext() {
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

/// Clients send no messages; reading answers pings and detects the end.
void WebSocket::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](const error_code& error, std::size_t) {
    if (error) return self->close();
    self->buffer_.clear();
    self->read();
  });
}

}  // namespace swiftlet::web
