// The page beside the flight: the server's thread, and the mailboxes and queues between it and the loops.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "common/command.hpp"
#include "common/event.hpp"
#include "common/mailbox.hpp"
#include "common/sensor_event.hpp"
#include "web/server/mission_shelf.hpp"
#include "web/server/web_server.hpp"

namespace swiftlet::flight {

struct FlightSetup;

/// What goes between the page and one vehicle.
class WebChannel {
 public:
  bool cameraWanted() const { return server_->cameraWanted(number_); }
  common::LatestValue<common::World>& world() { return world_; }
  common::LatestValue<common::CameraFrame>& camera() { return camera_; }
  common::LosslessQueue<common::OperatorCommand>& commands() { return commands_; }
  void postResult(common::CommandResult result) { results_.push(std::move(result)); }
  void postEvent(const common::Event& event) { server_->postEvent(event, number_); }

 private:
  friend class WebLink;

  web::WebServer* server_ = nullptr;
  std::size_t number_ = 0;
  common::LatestValue<common::World> world_;
  common::LatestValue<common::CameraFrame> camera_;
  common::LosslessQueue<common::OperatorCommand> commands_;
  common::LosslessQueue<common::CommandResult> results_;
};

class WebLink {
 public:
  /// Listens at once; throws common::InputError when it cannot. Token, clock and missions of the options are set here.
  /// `vehicles`: the names of several; empty for one that flies alone. `missions`: those a page may start; null: no
  /// missions.
  WebLink(web::WebServerOptions options, const std::vector<std::string>& vehicles,
          std::unique_ptr<web::MissionShelf> missions = nullptr);
  ~WebLink();

  std::vector<std::string> operatorUrls() const { return server_->operatorUrls(); }
  /// By the vehicle's number.
  WebChannel& channel(std::size_t number) { return *channels_.at(number); }

 private:
  std::vector<std::unique_ptr<WebChannel>> channels_;
  std::unique_ptr<web::MissionShelf> missions_;
  web::IoContext io_;
  std::unique_ptr<web::WebServer> server_;
  std::thread thread_;
};

/// The page of a flight, with its own mission and the shipped ones. `seed` is that of the particles in the maps that
/// missions load; `vehicles` as for WebLink. Throws common::InputError when it cannot listen.
std::unique_ptr<WebLink> servePage(web::WebServerOptions options, const FlightSetup& setup, std::uint64_t seed,
                                   const std::vector<std::string>& vehicles = {});

}  // namespace swiftlet::flight
