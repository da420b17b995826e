// What all connections of one server share, and the tick that drives the connections that receive data unasked.
// The tick runs only while there is such a connection, so that an unused server costs nothing. Everything runs on the
// one thread of the event loop, except what WebServer says.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include <boost/asio/steady_timer.hpp>

#include "web/server/command_desk.hpp"
#include "web/server/frame_hub.hpp"
#include "web/server/route.hpp"
#include "web/server/telemetry.hpp"
#include "web/server/web_server_options.hpp"

namespace swiftlet::web {

inline constexpr int kTicksPerSecond = 100;

/// A connection that the server can close and that may receive the tick.
class Connection {
 public:
  enum class Use { kRequests, kWatching };

  Connection(Use use, bool by_operator) : use_(use), by_operator_(by_operator) {}
  virtual ~Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  virtual void close() = 0;
  bool watches() const { return use_ == Use::kWatching; }
  /// The client has shown the operator's token, of an HTTP connection with its last request.
  bool byOperator() const { return by_operator_; }
  /// Every 10 ms, after Core::watch().
  virtual void tick(common::Time /*now*/) {}

 protected:
  void setByOperator(bool by_operator) { by_operator_ = by_operator; }

 private:
  Use use_;
  bool by_operator_;
};

/// One vehicle as the pages see it and send commands to.
struct WatchedVehicle {
  WatchedVehicle(const WebServerOptions& options, const WebServerSources& sources);

  std::string name;  ///< Empty when it flies alone.
  Telemetry telemetry;
  FrameHub hub;
  CommandDesk desk;
  std::atomic<int> camera_watchers = 0;
};

/// Slots, bandwidth and the thread's time are kept for the operator: viewers (who show no token) have
/// `max_connections` slots, `viewers_bytes_per_s` and a share of the time for drawing together, and one picture is
/// drawn for them in a tick. Operators have no limit and their turn comes first.
class Core : public std::enable_shared_from_this<Core> {
 public:
  /// `sources`: one for each vehicle, at least one.
  Core(boost::asio::io_context& io, WebServerOptions options_in, const std::vector<WebServerSources>& sources,
       Policy policy_in);

  /// Counts a connection and closes it when the server stops. Of too many that only send requests the oldest one
  /// without a token is closed, so that silent ones never lock others out.
  void add(const std::shared_ptr<Connection>& connection);
  /// The connection receives the tick as long as it lives.
  void watch(const std::shared_ptr<Connection>& connection);
  /// Makes the next tick come at once instead of at the idle rate. Call it at the start and after a command was given.
  void wake();
  /// True while a viewer may come to watch.
  bool roomForViewer() const;
  /// False while the viewers have used up their bandwidth.
  bool viewersMaySend() const { return viewer_credit_bytes_ > 0.0; }
  /// Counts what is sent to a connection.
  void sent(const Connection& to, std::size_t bytes);
  /// False for a viewer while the viewers have used up their time for drawing, or one was drawn for in this tick.
  bool mayDraw(const Connection& to) const { return to.byOperator() || viewersMayDraw(); }
  /// Counts the time that a picture for a connection took.
  void drew(const Connection& to, common::Duration time);
  void close();
  bool closed() const { return closed_; }

  /// The vehicle with that number, as route() gives it. The reference stays valid as long as this object.
  WatchedVehicle& vehicle(std::size_t number) { return *vehicles_[number]; }
  common::Time now() const { return options.unix_time(); }

  WebServerOptions options;
  Policy policy;

 private:
  void schedule();
  void tick();

  void tickWatchers(common::Time now);
  void refill(common::Time now);
  bool viewersMayDraw() const { return viewer_credit_s_ > 0.0 && !drew_for_viewer_; }
  bool anyWaiting() const;

  std::vector<std::unique_ptr<WatchedVehicle>> vehicles_;
  boost::asio::steady_timer timer_;
  std::vector<std::weak_ptr<Connection>> connections_;
  std::vector<std::weak_ptr<Connection>> watchers_;
  std::size_t first_viewer_ = 0;  ///< The viewer whose turn is next.
  double viewer_credit_bytes_;
  double viewer_credit_s_;        ///< Of drawing.
  bool drew_for_viewer_ = false;  ///< Since the last tick.
  common::Time refilled_;
  bool ticking_ = false;
  bool closed_ = false;
};

/// True `per_second` times a second, at the same instants for every connection, so that they can share what is sent.
class Beat {
 public:
  explicit Beat(double per_second) : per_second_(per_second) {}
  bool due(common::Time now) const { return indexOf(now) != last_; }
  void done(common::Time now) { last_ = indexOf(now); }

 private:
  std::int64_t indexOf(common::Time now) const { return static_cast<std::int64_t>(now.seconds() * per_second_); }
  double per_second_;
  std::int64_t last_ = -1;
};

/// Bytes in the kernel that the client has not taken yet.
int unsentBytes(int native_socket);
/// A client with more bytes waiting gets no new data, which would only grow old in the buffer.
inline constexpr int kMostUnsentBytes = 32 * 1024;
/// Bound of the kernel's own buffer; without it the buffer would hold seconds of old pictures.
inline constexpr int kSendBufferBytes = 128 * 1024;

}  // namespace swiftlet::web
