#include "apps/web_link.hpp"

#include <algorithm>
#include <chrono>

namespace swiftlet::apps {
namespace {

common::Time unixTime() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return common::Time::fromNanoseconds(std::chrono::duration_cast<std::chrono::nanoseconds>(since_epoch).count());
}

}  // namespace

WebLink::WebLink(web::WebServerOptions options, const std::vector<std::string>& vehicles,
                 std::unique_ptr<web::MissionShelf> missions)
    : missions_(std::move(missions)) {
  std::vector<web::WebServer::Sources> sources;
  for (std::size_t i = 0; i < std::max<std::size_t>(vehicles.size(), 1); ++i) {
    WebChannel& channel = *channels_.emplace_back(std::make_unique<WebChannel>());
    sources.push_back(
        {channel.world_, channel.camera_, channel.commands_, channel.results_, vehicles.empty() ? "" : vehicles[i]});
  }
  options.token = web::makeToken();
  options.unix_time = unixTime;
  options.missions = missions_.get();
  server_ = std::make_unique<web::WebServer>(io_, options, sources);
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    channels_[i]->server_ = server_.get();
    channels_[i]->number_ = i;
  }
  thread_ = std::thread([this] { io_.run(); });
}

WebLink::~WebLink() {
  server_->stop();
  thread_.join();
}

}  // namespace swiftlet::apps
