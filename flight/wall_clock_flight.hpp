// A flight of a real vehicle, from the check of its mission to the last file of its run: what a program of one's own
// needs beside the driver of its vehicle (docs/tutorials/own_vehicle.md).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flight/flight_setup.hpp"
#include "flight/groot_link.hpp"
#include "flight/memory_watch.hpp"
#include "flight/vehicle_flight.hpp"
#include "flight/wall_clock.hpp"
#include "flight/web_link.hpp"

namespace swiftlet::flight {

struct WallClockSetup : FlightSetup {
  std::optional<web::WebServerOptions> page = std::nullopt;  ///< nullopt: without the page.
  std::optional<int> groot_port = std::nullopt;  ///< On the address of the page; nullopt: without Groot2; 0: any.
  double speed = 1.0;                            ///< Times real time, above 0; for vehicles that are simulated.
};

/// One thread. The jobs run on threads of their own and are delivered when they are done.
class WallClockFlight {
 public:
  /// Checks and makes whatever can fail on the ground: mission, page, Groot, run folder. The vehicle must outlive it;
  /// its time should begin near 0, as the times in the run's files are its. Throws common::InputError.
  WallClockFlight(common::Vehicle& vehicle, WallClockSetup setup, FlightHooks hooks = {});

  /// The links to open; none without the page.
  std::vector<std::string> pages() const;
  /// nullopt without Groot.
  std::optional<int> grootPort() const;

  /// Flies until the mission has ended and the vehicle is at rest, the vehicle sends nothing more, or the hooks end it.
  /// Then the run is written, and the page still shows for two seconds how it ended. Call it once.
  VehicleResult fly();

 private:
  void warnIfLate(common::Time now);

  common::Vehicle& vehicle_;
  WallClockSetup setup_;
  FlightHooks hooks_;
  Pace pace_;
  MemoryWatch memory_;
  std::unique_ptr<WebLink> web_;
  std::unique_ptr<GrootLink> groot_;
  std::unique_ptr<VehicleFlight> flight_;
  bool warned_of_lateness_ = false;
};

}  // namespace swiftlet::flight
