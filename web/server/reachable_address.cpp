#include "web/server/reachable_address.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <cstring>
#include <memory>
#include <optional>

namespace swiftlet::web {
namespace {

using boost::asio::ip::address;
using boost::asio::ip::address_v4;
using boost::asio::ip::address_v6;

bool isLinkLocal(const address& candidate) {
  constexpr std::uint32_t kLinkLocal = 0xA9FE0000;  // 169.254.0.0/16
  return candidate.is_v6() ? candidate.to_v6().is_link_local()
                           : (candidate.to_v4().to_uint() & 0xFFFF0000) == kLinkLocal;
}

address addressIn(const sockaddr& socket) {
  if (socket.sa_family == AF_INET) {
    sockaddr_in v4{};
    std::memcpy(&v4, &socket, sizeof v4);
    return address_v4(ntohl(v4.sin_addr.s_addr));
  }
  sockaddr_in6 v6{};
  std::memcpy(&v6, &socket, sizeof v6);
  address_v6::bytes_type bytes;
  std::memcpy(bytes.data(), v6.sin6_addr.s6_addr, bytes.size());
  return address_v6(bytes);
}

std::optional<address> firstOutward(int family) {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return std::nullopt;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, &freeifaddrs);
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != family) continue;
    if ((entry->ifa_flags & IFF_UP) == 0 || (entry->ifa_flags & IFF_LOOPBACK) != 0) continue;
    if (const address found = addressIn(*entry->ifa_addr); !isLinkLocal(found)) return found;
  }
  return std::nullopt;
}

}  // namespace

address reachableAddress(const address& listening) {
  if (!listening.is_unspecified()) return listening;
  // A socket on :: takes IPv4 too.
  if (listening.is_v6())
    if (const auto found = firstOutward(AF_INET6)) return *found;
  if (const auto found = firstOutward(AF_INET)) return *found;
  return listening.is_v6() ? address(address_v6::loopback()) : address(address_v4::loopback());
}

}  // namespace swiftlet::web
