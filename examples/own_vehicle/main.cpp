// Flies a mission with a vehicle of one's own: the page, a run folder, Groot2, and Ctrl-C to land.
#include <cstdio>
#include <cstdlib>

#include "common/error.hpp"
#include "driver.hpp"
#include "flight/stop_signals.hpp"
#include "flight/wall_clock_flight.hpp"

namespace flight = swiftlet::flight;

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: own_vehicle MISSION.xml [SPEED [PORT]]\n"), 2;
  try {
    flight::WallClockSetup setup;
    setup.system = flight::loadSystem("swiftlet");
    setup.mission_file = argv[1];
    setup.speed = argc > 2 ? std::atof(argv[2]) : 1.0;
    setup.page.emplace().port = argc > 3 ? std::atoi(argv[3]) : 8080;
    setup.groot_port = 0;

    const flight::StopSignals& signals = flight::stopOnSignals();
    flight::FlightHooks hooks{.land = &signals.first, .stop = &signals.second};
    hooks.event = [](const swiftlet::common::Event& event) {
      std::printf("%5.1f s  %s: %s\n", event.stamp.seconds(), event.source.c_str(), event.text.c_str());
    };
    Driver vehicle(setup.system.laser);
    flight::WallClockFlight flight(vehicle, setup, hooks);
    std::printf("page    %s\ngroot   port %d\n", flight.pages().front().c_str(), *flight.grootPort());

    const flight::VehicleResult result = flight.fly();
    std::printf("%s %s\nrun     %s\n", toString(result.summary.outcome), result.summary.reason.c_str(),
                result.folder.c_str());
    return result.done() ? 0 : 1;
  } catch (const swiftlet::common::InputError& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
}
