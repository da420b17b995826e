// The page of a flight: the server's thread, and the mailboxes and queues between it and the loop.
#pragma once

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "common/command.hpp"
#include "common/event.hpp"
#include "common/mailbox.hpp"
#include "common/sensor_event.hpp"
#include "web/server/web_server.hpp"

namespace swiftlet::apps {

class WebLink {
 public:
  /// Starts to listen at once; throws common::InputError if it cannot.
  WebLink(const std::string& address, int port, const std::string& title, double hull_diameter_m);
  ~WebLink();

  std::string operatorUrl() const { return server_->operatorUrl(); }
  bool cameraWanted() const { return server_->cameraWanted(); }
  common::LatestValue<common::World>& world() { return world_; }
  common::LatestValue<common::CameraFrame>& camera() { return camera_; }
  common::LosslessQueue<common::OperatorCommand>& commands() { return commands_; }
  void postResult(common::CommandResult result) { results_.push(std::move(result)); }
  void postEvent(const common::Event& event) { server_->postEvent(event); }

 private:
  common::LatestValue<common::World> world_;
  common::LatestValue<common::CameraFrame> camera_;
  common::LosslessQueue<common::OperatorCommand> commands_;
  common::LosslessQueue<common::CommandResult> results_;
  web::IoContext io_;
  std::unique_ptr<web::WebServer> server_;
  std::thread thread_;
};

}  // namespace swiftlet::apps
