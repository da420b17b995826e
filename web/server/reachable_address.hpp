// The address by which other machines reach this one.
#pragma once

#include <boost/asio/ip/address.hpp>

namespace swiftlet::web {

/// The address to open for a server that listens on `listening`: that address itself, unless it is "every interface"
/// (0.0.0.0, ::). Then it is the first address of an interface that is up, neither loopback nor link-local; for :: an
/// IPv6 one if there is one. It is the loopback if this machine has no network. Asks the kernel; any thread.
boost::asio::ip::address reachableAddress(const boost::asio::ip::address& listening);

}  // namespace swiftlet::web
