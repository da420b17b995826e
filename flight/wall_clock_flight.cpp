#include "flight/wall_clock_flight.hpp"

#include <algorithm>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "flight/files_of_kind.hpp"

namespace swiftlet::flight {
namespace {

constexpr int kParticleSeed = 1;

/// One core is the loop's. There are two threads at least, so that no plan waits for a loop closure.
int jobThreads() { return std::max(2, static_cast<int>(std::thread::hardware_concurrency()) - 1); }

}  // namespace

WallClockFlight::WallClockFlight(common::Vehicle& vehicle, WallClockSetup setup, FlightHooks hooks)
    : vehicle_(vehicle), setup_(std::move(setup)), hooks_(std::move(hooks)), pace_(setup_.speed) {
  setup_.mission_file = findMission(setup_.mission_file);
  if (setup_.record_rgbd) requireCamera(setup_.system);
  FlightMission mission =
      std::move(soundMissions({setup_.mission_file}, setup_, setup_.map != nullptr, kParticleSeed).front());
  if (setup_.page) web_ = servePage(*setup_.page, setup_, kParticleSeed);
  if (setup_.groot_port)
    groot_ = std::make_unique<GrootLink>(setup_.page.value_or(web::WebServerOptions()).address, *setup_.groot_port,
                                         *setup_.types);
  FlownVehicle flown{
      .vehicle = vehicle, .folder = folderOf(setup_), .web = web_ ? &web_->channel(0) : nullptr, .groot = groot_.get()};
  flown.info.seed = kParticleSeed;
  flight_ = std::make_unique<VehicleFlight>(setup_, hooks_, std::move(flown), std::move(mission),
                                            common::makeWallClockJobs(jobThreads(), [this] { return pace_.now(); }));
}

std::vector<std::string> WallClockFlight::pages() const {
  return web_ ? web_->operatorUrls() : std::vector<std::string>();
}

std::optional<int> WallClockFlight::grootPort() const { return groot_ ? std::optional(groot_->port()) : std::nullopt; }

VehicleResult WallClockFlight::fly() {
  common::Time now = vehicle_.now();
  pace_ = Pace(setup_.speed, now);  // No job is under way yet that asks for the time.
  flight_->begin();
  while (!flight_->over()) {
    now += common::kControlPeriod;
    pace_.waitUntil(now);
    warnIfLate(now);
    flight_->step(now);
    memory_.look();
  }
  flight_->finish(pace_.wall_s(), memory_);
  if (web_) lingerForPages(hooks_.stop);
  return flight_->result();
}

/// Measurements wait, and setpoints come late.
void WallClockFlight::warnIfLate(common::Time now) {
  constexpr double kLate_s = 0.1;
  const double late_s = (pace_.now() - now).seconds();
  if (warned_of_lateness_ || late_s < kLate_s) return;
  warned_of_lateness_ = true;
  flight_->tell(common::Severity::kWarning, "program", "the computer is too slow for the flight",
                fmt::format("its loop is {:.2f} s behind", late_s));
}

}  // namespace swiftlet::flight
