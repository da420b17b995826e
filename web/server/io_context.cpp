#include "web/server/io_context.hpp"

#include <boost/asio/io_context.hpp>

namespace swiftlet::web {

IoContext::IoContext() : context_(std::make_unique<boost::asio::io_context>(1)) {}
IoContext::~IoContext() = default;

void IoContext::run() { context_->run(); }

}  // namespace swiftlet::web
