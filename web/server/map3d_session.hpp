// One page that draws the 3D map itself, connected by WebSocket. It is sent the messages of a SubmapReader.
#pragma once

#include "web/server/web_socket.hpp"

namespace swiftlet::web {

void startMap3d(std::shared_ptr<Core> core, std::size_t vehicle, boost::asio::ip::tcp::socket socket,
                const WebSocket::Upgrade& upgrade, bool by_operator);

}  // namespace swiftlet::web
