#include "flight/web_link.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

#include "flight/flight_setup.hpp"
#include "flight/mission_shelf.hpp"

namespace swiftlet::flight {
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

std::unique_ptr<WebLink> servePage(web::WebServerOptions options, const FlightSetup& setup, std::uint64_t seed,
                                   const std::vector<std::string>& vehicles) {
  options.hull_diameter_m = setup.system.vehicle.hull_diameter_m;
  if (options.title.empty()) options.title = std::filesystem::path(setup.mission_file).stem().string();
  return std::make_unique<WebLink>(
      std::move(options), vehicles,
      std::make_unique<FolderShelf>(setup.mission_file, shippedMissions(), seed, setup.types));
}

}  // namespace swiftlet::flight
