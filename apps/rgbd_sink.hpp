// Records what the RGB-D camera of a simulated flight saw, with its true poses, in the folder rgbd of the run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "autonomy/loop/flight_sink.hpp"
#include "interfaces/rgbd/rgbd_recorder.hpp"

namespace swiftlet::simulation {
class SimulatedVehicle;
}

namespace swiftlet::apps {

class RgbdSink final : public autonomy::FlightSink {
 public:
  /// Refers to the vehicle, which must outlive every call of input() and ticked(). `T_body_camera` is the true one.
  RgbdSink(const std::filesystem::path& run, const simulation::SimulatedVehicle& vehicle,
           const common::Pose3& T_body_camera);

  void input(const autonomy::Input& input) override;
  void ticked(const autonomy::TickOutcome& outcome) override;

  /// Why something could not be written; nullopt without a failure. Nothing is written after that.
  const std::optional<std::string>& failure() const { return failure_; }
  /// See RgbdRecorder::add.
  std::size_t leftOut() const { return recorder_ ? recorder_->leftOut() : 0; }

 private:
  void note(const interfaces::Written& written);

  const simulation::SimulatedVehicle& vehicle_;
  common::Pose3 T_body_camera_;
  std::optional<interfaces::RgbdRecorder> recorder_;
  std::optional<std::string> failure_;
};

}  // namespace swiftlet::apps
