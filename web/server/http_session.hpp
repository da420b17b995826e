// One HTTP connection: reads a request, calls route(), answers, and hands the socket to a stream or a WebSocket session
// if needed. Requests are limited in size and time.
#pragma once

#include <memory>

#include <boost/asio/ip/tcp.hpp>

#include "web/server/core.hpp"

namespace swiftlet::web {

void startHttp(std::shared_ptr<Core> core, boost::asio::ip::tcp::socket socket);

}  // namespace swiftlet::web
