#include "tests/flight/tablet.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace swiftlet::flight {

Tablet::Tablet(int port) : thread_([this, port] { watch(port); }) {}

Tablet::~Tablet() {
  stop_ = true;
  thread_.join();
}

void Tablet::watch(int port) {
  const int link = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const std::string request = "GET /stream/map.mjpg?width=480&fps=15 HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
  bool open = connect(link, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 &&
              send(link, request.data(), request.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(request.size());
  std::array<char, 65536> buffer;
  char last = 0;
  while (open && !stop_) {
    pollfd waiting{link, POLLIN, 0};
    if (poll(&waiting, 1, 50) <= 0) continue;
    const ssize_t count = recv(link, buffer.data(), buffer.size(), 0);
    open = count > 0;
    for (ssize_t i = 0; i < count; ++i) {
      const char byte = buffer[static_cast<std::size_t>(i)];
      if (last == '\xff' && byte == '\xd8') ++frames_;  // A JPEG begins.
      last = byte;
    }
  }
  close(link);
}

}  // namespace swiftlet::flight
