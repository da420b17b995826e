#include "apps/web_link.hpp"

#include <chrono>

namespace swiftlet::apps {
namespace {

common::Time unixTime() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return common::Time::fromNanoseconds(std::chrono::duration_cast<std::chrono::nanoseconds>(since_epoch).count());
}

}  // namespace

WebLink::WebLink(const std::string& address, int port, const std::string& title, double hull_diameter_m) {
  web::WebServer::Options options;
  options.address = address;
  options.port = port;
  options.token = web::makeToken();
  options.title = title;
  options.hull_diameter_m = hull_diameter_m;
  options.unix_time = unixTime;
  server_ =
      std::make_unique<web::WebServer>(io_, options, web::WebServer::Sources{world_, camera_, commands_, results_});
  thread_ = std::thread([this] { io_.run(); });
}

WebLink::~WebLink() {
  server_->stop();
  thread_.join();
}

}  // namespace swiftlet::apps
