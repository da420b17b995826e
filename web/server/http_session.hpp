// One HTTP connection: reads a request, lets route() decide, answers; hands the socket on where a stream or a WebSocket
// begins. Requests are limited in size and time.
#pragma once

#include <memory>

#include <boost/asio/ip/tcp.hpp>

#include "web/server/core.hpp"

namespace swiftlet::web {

void startHttp(std::shared_ptr<Core> core, boost::asio::ip::tcp::socket socket);

}  // namespace swiftlet::web
