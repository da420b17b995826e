// One page connected by WebSocket. Ten times a second it is sent what has changed since the last time:
//   text   {"type": "hello" | "state" | "frontiers" | "levels" | "given_map" | "trail" | "events" | "tree", ...}
//   binary map tiles (see TileReader) and laser points (see PageParts::laser)
// A slow page skips states and gets the newest; nothing is queued for it.
#pragma once

#include "web/server/web_socket.hpp"

namespace swiftlet::web {

void startPage(std::shared_ptr<Core> core, std::size_t vehicle, boost::asio::ip::tcp::socket socket,
               const WebSocket::Upgrade& upgrade, bool by_operator);

}  // namespace swiftlet::web
