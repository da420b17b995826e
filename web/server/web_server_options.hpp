// Options of the server of the operator's page.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/command.hpp"
#include "common/mailbox.hpp"
#include "common/sensor_event.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::web {

class MissionShelf;

struct WebServerOptions {
  std::string address = "127.0.0.1";  ///< IPv4 or IPv6 to listen on; "0.0.0.0" is every interface.
  int port = 8080;                    ///< Port; 0 for any free one.
  /// Addresses by which the page is opened besides the one listened on: "https://field.example/swiftlet/" of a proxy,
  /// "http://drone.local:8080/". Their names are accepted as Host, their pages as those of this server.
  std::vector<std::string> public_urls;
  std::string token;  ///< The token of an operator; at least 8 characters of [A-Za-z0-9_-].
  std::string title;  ///< Shown on the page: "explore_and_return in unb_case1".
  double hull_diameter_m = 0.55;
  double command_timeout_s = 2.0;     ///< How long an answer waits for the CommandResult.
  double stall_timeout_s = 10.0;      ///< A stream's client that takes nothing for this long is dropped.
  int max_connections = 256;          ///< Viewers that watch at the same time; operators are not counted.
  double viewers_bytes_per_s = 16e6;  ///< For all viewers together, so that the operator's page is not starved.
  MissionShelf* missions = nullptr;   ///< Missions that a page may start; null: no missions. Outlives IoContext::run().
  /// The present time since 1970, for the age of frames only. Called from the thread that runs the IoContext.
  std::function<common::Time()> unix_time;
};

/// Where the telemetry of a vehicle comes from and its commands go to; all must outlive IoContext::run(). Commands
/// carry ids that rise from 1; each result in `results` answers the command with its id.
struct WebServerSources {
  const common::LatestValue<common::World>& world;
  const common::LatestValue<common::CameraFrame>& camera;
  common::LosslessQueue<common::OperatorCommand>& commands;
  common::LosslessQueue<common::CommandResult>& results;
  std::string name = {};  ///< Unique among several vehicles; empty for a single one.
};

}  // namespace swiftlet::web
