// One client of a picture stream. At most one frame is being sent. The newest frame is taken when it is due and the
// last one has left the machine. A client that takes nothing for Options::stall_timeout_s is dropped.
#pragma once

#include <memory>

#include <boost/asio/ip/tcp.hpp>

#include "web/server/core.hpp"

namespace swiftlet::web {

void startStream(std::shared_ptr<Core> core, boost::asio::ip::tcp::socket socket, const StreamPictures& asked,
                 bool by_operator);

}  // namespace swiftlet::web
