// The sinks of a simulated flight: its run folder, the scorer's recorder, the page, the terminal.
#pragma once

#include <functional>
#include <memory>

#include "autonomy/loop/flight_sink.hpp"

namespace swiftlet::evaluation {
class FlightRecorder;
class OperatorScript;
}  // namespace swiftlet::evaluation
namespace swiftlet::interfaces {
class RunFolder;
}
namespace swiftlet::simulation {
class SimulatedVehicle;
}

namespace swiftlet::apps {

class WebChannel;

/// Each sink refers to its arguments, which must outlive it.
class FolderSink final : public autonomy::FlightSink {
 public:
  explicit FolderSink(interfaces::RunFolder& folder) : folder_(folder) {}
  void ticked(const autonomy::TickOutcome& outcome) override;
  void world(const std::shared_ptr<const common::World>& world) override;
  void file(const autonomy::RunFile& file) override;
  void event(const common::Event& event) override;

 private:
  interfaces::RunFolder& folder_;
};

/// Records the truth together with the estimates, and reports the flight's phase to the simulation.
class TruthSink final : public autonomy::FlightSink {
 public:
  TruthSink(simulation::SimulatedVehicle& vehicle, evaluation::FlightRecorder& recorder)
      : vehicle_(vehicle), recorder_(recorder) {}
  void input(const autonomy::Input& input) override;
  void ticked(const autonomy::TickOutcome& outcome) override;
  void world(const std::shared_ptr<const common::World>& world) override;

 private:
  simulation::SimulatedVehicle& vehicle_;
  evaluation::FlightRecorder& recorder_;
};

/// Shows the flight to the scripted operator.
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

class PageSink final : public autonomy::FlightSink {
 public:
  explicit PageSink(WebChannel& web) : web_(web) {}
  /// The newest camera frame.
  void input(const autonomy::Input& input) override;
  void world(const std::shared_ptr<const common::World>& world) override;
  void event(const common::Event& event) override;
  void result(const common::CommandResult& result) override;

 private:
  WebChannel& web_;
};

class EventSink final : public autonomy::FlightSink {
 public:
  using Report = std::function<void(const common::Event&)>;
  explicit EventSink(Report report) : report_(std::move(report)) {}
  void event(const common::Event& event) override { report_(event); }

 private:
  Report report_;
};

}  // namespace swiftlet::apps
