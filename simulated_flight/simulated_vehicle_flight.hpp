// One vehicle of a simulated flight: flight::VehicleFlight with the vehicle in the arena, and beside it what only the
// simulator has: the truth, the scorer's recorder and the operator of a script.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "flight/vehicle_flight.hpp"
#include "simulated_flight/simulated_setup.hpp"
#include "simulated_flight/truth.hpp"
#include "simulated_flight/visual_odometry_sink.hpp"

namespace swiftlet::simulation {
class Arena;
}

namespace swiftlet::simulated_flight {

/// One thread. Refers to the setup and the hooks, which must outlive it.
class SimulatedVehicleFlight {
 public:
  /// Vehicle number `number` of the arena, whose run lies in `folder`. Throws common::InputError for a folder that
  /// cannot be used.
  SimulatedVehicleFlight(const SimulatedSetup& setup, const SimulatedHooks& hooks,
                         const std::shared_ptr<simulation::Arena>& arena, std::size_t number,
                         flight::FlightMission mission, const std::filesystem::path& folder);
  SimulatedVehicleFlight(const SimulatedVehicleFlight&) = delete;
  SimulatedVehicleFlight& operator=(const SimulatedVehicleFlight&) = delete;

  /// Tells what was skipped or replaced in the world, too.
  void begin();
  void step(common::Time now);
  bool over();
  /// Also leaves the arena, where the vehicle stays as it is.
  void finish(double wall_s, flight::MemoryWatch& memory);
  bool finished() const { return vehicle_ == nullptr; }

  std::shared_ptr<const common::World> world() const { return flight_.world(); }
  flight::VehicleResult result() const { return flight_.result(); }

 private:
  flight::FlownVehicle flown(std::size_t number, const std::filesystem::path& folder);

  const SimulatedSetup& setup_;
  const SimulatedHooks& hooks_;
  std::unique_ptr<simulation::SimulatedVehicle> vehicle_;
  evaluation::FlightRecorder recorder_;
  evaluation::OperatorScript script_;
  Truth truth_;
  OperatorSink operator_;
  std::unique_ptr<VisualOdometrySink> visual_odometry_;  ///< Null unless requested.
  flight::WebChannel* web_;                              ///< Null without a page.
  flight::VehicleFlight flight_;
};

}  // namespace swiftlet::simulated_flight
