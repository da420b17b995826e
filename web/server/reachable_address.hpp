// By which address other machines reach this one.
#pragma once

#include <boost/asio/ip/address.hpp>

namespace swiftlet::web {

/// Where to open what listens on `listening`: that address itself, unless it is "every interface" (0.0.0.0, ::). Then
/// the first address of an interface that is up, neither loopback nor link-local; for :: an IPv6 one if there is one.
/// The loopback where this machine has no network. Asks the kernel; any thread.
boost::asio::ip::address reachableAddress(const boost::asio::ip::address& listening);

}  // namespace swiftlet::web
