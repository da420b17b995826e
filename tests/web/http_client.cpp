#include "tests/web/http_client.hpp"

#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "tests/support/patience.hpp"

namespace swiftlet::testing {

RawClient::RawClient(int port, double timeout_s) : socket_(io_) {
  socket_.connect({boost::asio::ip::address_v4::loopback(), static_cast<unsigned short>(port)});
  timeout_s *= test_support::patience();
  const auto whole = static_cast<long>(timeout_s);
  const timeval timeout{whole, std::lround((timeout_s - static_cast<double>(whole)) * 1e6)};
  setsockopt(nativeSocket(), SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
}

void RawClient::send(const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const auto sent = ::send(nativeSocket(), bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
    if (sent <= 0) return;
    at += static_cast<std::size_t>(sent);
  }
}

bool RawClient::fill() {
  std::array<char, 65536> bytes;
  const auto count = ::recv(nativeSocket(), bytes.data(), bytes.size(), 0);
  if (count <= 0) return false;
  buffer_.append(bytes.data(), static_cast<std::size_t>(count));
  return true;
}

std::string RawClient::readUntil(const std::string& end) {
  std::size_t at;
  while ((at = buffer_.find(end)) == std::string::npos)
    if (!fill()) return std::exchange(buffer_, {});
  std::string result = buffer_.substr(0, at + end.size());
  buffer_.erase(0, at + end.size());
  return result;
}

std::string RawClient::readBytes(std::size_t count) {
  while (buffer_.size() < count)
    if (!fill()) break;
  std::string result = buffer_.substr(0, count);
  buffer_.erase(0, result.size());
  return result;
}

Reply RawClient::readReply() {
  Reply reply;
  std::string head = readUntil("\r\n\r\n");
  if (head.rfind("HTTP/1.1 ", 0) != 0) return reply;
  reply.status = std::stoi(head.substr(9, 3));
  for (std::size_t at = head.find("\r\n") + 2; at < head.size();) {
    const std::size_t end = head.find("\r\n", at);
    const std::string line = head.substr(at, end - at);
    at = end + 2;
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    std::string name = line.substr(0, colon);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    reply.headers[name] = line.substr(colon + 2);
  }
  if (const auto it = reply.headers.find("content-length"); it != reply.headers.end())
    reply.body = readBytes(std::stoul(it->second));
  return reply;
}

bool RawClient::closed() {
  char byte = 0;
  return ::recv(nativeSocket(), &byte, 1, 0) == 0;
}

Reply request(int port, const std::string& method, const std::string& target, const std::string& extra,
              const std::string& body) {
  RawClient client(port);
  client.send(fmt::format("{} {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nContent-Length: {}\r\n{}\r\n{}", method, target,
                          port, body.size(), extra, body));
  return client.readReply();
}

std::string bearer() { return "Authorization: Bearer operator-token\r\n"; }

}  // namespace swiftlet::testing
