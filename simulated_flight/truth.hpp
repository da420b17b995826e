// The truth of a simulated flight, for its records and its score; and the operator of a trial's script.
#pragma once

#include <memory>

#include "autonomy/loop/flight_sink.hpp"
#include "flight/motion_reference.hpp"

namespace swiftlet::evaluation {
class FlightRecorder;
class OperatorScript;
}  // namespace swiftlet::evaluation
namespace swiftlet::simulation {
class SimulatedVehicle;
}

namespace swiftlet::simulated_flight {

/// Records the truth together with the estimates, and reports the flight's phase to the simulation. Refers to its
/// arguments, which must outlive every call.
class Truth final : public autonomy::FlightSink, public flight::MotionReference {
 public:
  Truth(simulation::SimulatedVehicle& vehicle, evaluation::FlightRecorder& recorder)
      : vehicle_(vehicle), recorder_(recorder) {}

  void input(const autonomy::Input& input) override;
  void ticked(const autonomy::TickOutcome& outcome) override;
  void world(const std::shared_ptr<const common::World>& world) override;
  void event(const common::Event& event) override;

  common::Pose3 T_map_body() const override;
  Eigen::Vector3d velocity_map_m_s() const override;
  common::Pose3 T_map_camera() const override;
  bool airborne() const override;
  const common::Trajectory& path_map() const override;

 private:
  simulation::SimulatedVehicle& vehicle_;
  evaluation::FlightRecorder& recorder_;
};

/// Shows the flight to the scripted operator, which must outlive it.
class OperatorSink final : public autonomy::FlightSink {
 public:
  explicit OperatorSink(evaluation::OperatorScript& script) : script_(script) {}
  void ticked(const autonomy::TickOutcome& outcome) override;
  void world(const std::shared_ptr<const common::World>& world) override;
  void event(const common::Event& event) override;
  void result(const common::CommandResult& result) override;

 private:
  evaluation::OperatorScript& script_;
};

}  // namespace swiftlet::simulated_flight
