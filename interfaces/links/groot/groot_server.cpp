#include "interfaces/links/groot/groot_server.hpp"

#include "common/error.hpp"

#ifdef SWIFTLET_WITH_ZMQ
#include <zmq.h>
#endif

namespace swiftlet::interfaces {

#ifdef SWIFTLET_WITH_ZMQ

namespace {

/// Larger requests are no requests of Groot2; the socket drops their connection.
constexpr std::int64_t kMostRequestBytes = std::int64_t{1} << 20;

}  // namespace

bool hasGrootServer() { return true; }

struct GrootServer::Socket {
  Socket() : context(zmq_ctx_new()), socket(zmq_socket(context, ZMQ_REP)) {
    set(ZMQ_LINGER, 0);
    zmq_setsockopt(socket, ZMQ_MAXMSGSIZE, &kMostRequestBytes, sizeof kMostRequestBytes);
  }
  ~Socket() {
    zmq_close(socket);
    zmq_ctx_term(context);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  void set(int option, int value) { zmq_setsockopt(socket, option, &value, sizeof value); }

  /// The parts of the next request; empty if none came within the time.
  std::vector<std::string> receive() {
    std::vector<std::string> parts;
    bool more = true;
    while (more) {
      zmq_msg_t part;
      zmq_msg_init(&part);
      const bool received = zmq_msg_recv(&part, socket, 0) >= 0;
      if (received) parts.emplace_back(static_cast<const char*>(zmq_msg_data(&part)), zmq_msg_size(&part));
      more = received && zmq_msg_more(&part) != 0;
      zmq_msg_close(&part);
    }
    return parts;
  }

  void send(const std::vector<std::string>& parts) {
    for (std::size_t i = 0; i < parts.size(); ++i)
      zmq_send(socket, parts[i].data(), parts[i].size(), i + 1 < parts.size() ? ZMQ_SNDMORE : 0);
  }

  void* context;
  void* socket;
};

GrootServer::GrootServer(const std::string& address, int port) : socket_(std::make_unique<Socket>()) {
  const std::string endpoint = "tcp://" + address + ":" + (port == 0 ? "*" : std::to_string(port));
  if (zmq_bind(socket_->socket, endpoint.c_str()) != 0)
    throw common::InputError(
        {}, "--groot",
        common::Message("server.cannot-listen", "cannot listen on {}: {}", endpoint, zmq_strerror(zmq_errno())),
        "choose another port above 1023; 0 picks a free one");
  socket_->set(ZMQ_SNDTIMEO, 1000);
}

GrootServer::~GrootServer() = default;

int GrootServer::port() const {
  char endpoint[256] = "";
  std::size_t size = sizeof endpoint;
  zmq_getsockopt(socket_->socket, ZMQ_LAST_ENDPOINT, endpoint, &size);
  const std::string text = endpoint;
  return std::stoi(text.substr(text.rfind(':') + 1));
}

bool GrootServer::serve(GrootMonitor& monitor, int patience_ms) {
  socket_->set(ZMQ_RCVTIMEO, patience_ms);
  const std::vector<std::string> request = socket_->receive();
  if (request.empty()) return false;
  socket_->send(monitor.answer(request));
  return true;
}

#else

bool hasGrootServer() { return false; }

struct GrootServer::Socket {};

GrootServer::GrootServer(const std::string&, int) {
  throw common::InputError({}, "--groot", common::Message("groot.no-zeromq", "this build has no ZeroMQ"),
                           "install libzmq3-dev and build again");
}

GrootServer::~GrootServer() = default;
int GrootServer::port() const { return 0; }
bool GrootServer::serve(GrootMonitor&, int) { return false; }

#endif

}  // namespace swiftlet::interfaces
