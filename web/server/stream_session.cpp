#include "web/server/stream_session.hpp"

#include <array>

#include <fmt/format.h>
#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>

namespace swiftlet::web {
namespace {

using boost::system::error_code;

class StreamSession : public Connection, public std::enable_shared_from_this<StreamSession> {
 public:
  StreamSession(std::shared_ptr<Core> core, boost::asio::ip::tcp::socket socket, const StreamPictures& asked,
                bool by_operator)
      : Connection(Use::kWatching, by_operator),
        core_(std::move(core)),
        vehicle_(core_->vehicle(asked.vehicle)),
        socket_(std::move(socket)),
        view_(vehicle_.hub.watch(asked.view)),
        watcher_{.period = common::Duration::fromSeconds(1.0 / asked.fps), .by_operator = by_operator},
        beat_(asked.fps),
        watches_camera_(asked.view.source == PictureView::Source::kCamera) {
    if (watches_camera_) ++vehicle_.camera_watchers;
  }

  ~StreamSession() override {
    if (watches_camera_) --vehicle_.camera_watchers;
  }

  void start() {
    error_code ignored;
    socket_.set_option(boost::asio::ip::tcp::no_delay(true), ignored);
    socket_.set_option(boost::asio::socket_base::send_buffer_size(kSendBufferBytes), ignored);
    // The end of the connection is that of the stream, which HTTP/1.0 understands too. X-Accel-Buffering keeps nginx
    // from collecting pictures.
    head_ = fmt::format(
        "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary={0}\r\nCache-Control: no-store\r\n"
        "X-Content-Type-Options: nosniff\r\nX-Accel-Buffering: no\r\nConnection: close\r\n\r\n--{0}\r\n",
        kStreamBoundary);
    self_ = shared_from_this();
    core_->add(self_);
    core_->watch(self_);
    listen();
  }

  void close() override {
    error_code ignored;
    socket_.close(ignored);
    self_.reset();
  }

  void tick(common::Time now) override {
    if (!self_) return;
    if (writing_ || unsentBytes(socket_.native_handle()) > kMostUnsentBytes) {
      if (++stalled_ticks_ > core_->options.stall_timeout_s * kTicksPerSecond) close();
      return;
    }
    stalled_ticks_ = 0;
    if (!beat_.due(now)) return;
    if (vehicle_.hub.due(*view_, watcher_) && core_->mayDraw(*this))
      core_->drew(*this, vehicle_.hub.draw(*view_, watcher_));
    const auto frame = vehicle_.hub.frame(*view_, watcher_);
    // Without something new the client stays due, so that it need not wait for the next beat when it comes.
    if (!frame) return;
    beat_.done(now);
    send(frame, now);
  }

 private:
  void send(const std::shared_ptr<const StreamFrame>& frame, common::Time now) {
    writing_ = true;
    watcher_.last = frame;
    watcher_.sent = now;
    core_->sent(*this, frame->bytes.size());
    const std::array<boost::asio::const_buffer, 2> buffers{boost::asio::buffer(head_),
                                                           boost::asio::buffer(frame->bytes)};
    boost::asio::async_write(socket_, buffers,
                             [self = shared_from_this(), frame](const error_code& error, std::size_t) {
                               self->writing_ = false;
                               self->head_.clear();
                               if (error) self->close();
                             });
  }

  /// A client sends nothing more; the read ends when it goes away.
  void listen() {
    socket_.async_read_some(boost::asio::buffer(ignored_),
                            [self = shared_from_this()](const error_code& error, std::size_t) {
                              if (error) return self->close();
                              self->listen();
                            });
  }

  std::shared_ptr<Core> core_;
  WatchedVehicle& vehicle_;
  boost::asio::ip::tcp::socket socket_;
  std::shared_ptr<FrameHub::View> view_;
  FrameHub::Watcher watcher_;
  Beat beat_;
  bool watches_camera_;
  std::shared_ptr<StreamSession> self_;  ///< Keeps the session alive until it is closed.
  std::string head_;
  bool writing_ = false;
  int stalled_ticks_ = 0;
  std::array<char, 64> ignored_{};
};

}  // namespace

void startStream(std::shared_ptr<Core> core, boost::asio::ip::tcp::socket socket, const StreamPictures& asked,
                 bool by_operator) {
  std::make_shared<StreamSession>(std::move(core), std::move(socket), asked, by_operator)->start();
}

}  // namespace swiftlet::web
