// A WebSocket that sends what is new at a steady beat. Nothing is queued for a slow client: its next message is
// made only when everything before has left the machine.
#pragma once

#include <deque>
#include <memory>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "web/server/core.hpp"

namespace swiftlet::web {

class WebSocket : public Connection, public std::enable_shared_from_this<WebSocket> {
 public:
  using Upgrade = boost::beast::http::request<boost::beast::http::string_body>;

  WebSocket(std::shared_ptr<Core> core, boost::asio::ip::tcp::socket socket, bool by_operator,
            double collects_per_second);

  void start(const Upgrade& upgrade);
  void close() override;
  void tick(common::Time now) final;

 protected:
  /// Once, when the socket is open.
  virtual void opened() {}
  /// Queues what the client should get now.
  virtual void collect(common::Time now) = 0;

  void queue(SharedText text, bool binary) { queue_.push_back({std::move(text), binary}); }
  void queueText(std::string text) { queue(std::make_shared<const std::string>(std::move(text)), false); }
  Core& core() { return *core_; }

 private:
  struct Message {
    SharedText text;
    bool binary;
  };

  boost::asio::ip::tcp::socket& tcp() { return boost::beast::get_lowest_layer(stream_).socket(); }
  void writeNext();
  void read();

  std::shared_ptr<Core> core_;
  /// Without compression, which is never asked for and takes as long to compile as all the rest.
  boost::beast::websocket::stream<boost::beast::tcp_stream, false> stream_;
  boost::beast::flat_buffer buffer_;
  std::deque<Message> queue_;
  Beat beat_;
  bool open_ = false;
  bool writing_ = false;
};

}  // namespace swiftlet::web
