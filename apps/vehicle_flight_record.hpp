// What is kept of one vehicle's flight: its run folder with pictures and logs, and the recorder of the score.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/control_log_sink.hpp"
#include "apps/flight_setup.hpp"
#include "apps/map3d_sink.hpp"
#include "apps/picture_sink.hpp"
#include "apps/rgbd_sink.hpp"
#include "apps/visual_odometry_sink.hpp"

namespace swiftlet::apps {

/// One thread. Refers to the setup and the vehicle; the vehicle may end once the flight is over.
class VehicleFlightRecord {
 public:
  using Observers = std::vector<std::unique_ptr<autonomy::FlightSink>>;

  /// `observers` see the flight beside the record. Throws common::InputError for a folder that cannot be used.
  VehicleFlightRecord(const FlightSetup& setup, simulation::SimulatedVehicle& vehicle, const std::string& mission_file,
                      const std::filesystem::path& folder, Observers observers);

  /// All sinks of the flight. The pictures come last: they show what the others have written.
  std::vector<autonomy::FlightSink*> sinks();
  /// Null unless requested.
  perception::FilterListener* filterListener() { return control_log_.get(); }
  const common::Trajectory& truth_map() const { return recorder_.truth_map(); }
  const interfaces::RunFolder& folder() const { return folder_; }

  /// After the last tick: the pictures, the 3D map and the logs of the end.
  void writeLast(const common::World& world);
  /// What the scorer sees. Call it once, at the end.
  evaluation::FlightRecord take();
  /// Frames of the RGB-D camera that were not recorded.
  std::size_t framesLeftOut() const { return rgbd_ ? rgbd_->leftOut() : 0; }
  /// Keeps what was learned, if the setup asks for it.
  void keepMemory(const autonomy::VehicleMemory& learned, interfaces::FlightEnd& end);
  void finish(const interfaces::FlightEnd& end) { folder_.finish(end); }
  /// Why something could not be written; nullopt without a failure.
  std::optional<std::string> failure() const;

 private:
  const FlightSetup& setup_;
  evaluation::FlightRecorder recorder_;
  interfaces::RunFolder folder_;
  std::vector<std::unique_ptr<autonomy::FlightSink>> sinks_;
  std::unique_ptr<ControlLogSink> control_log_;          ///< Null unless requested.
  std::unique_ptr<RgbdSink> rgbd_;                       ///< Null unless requested.
  std::unique_ptr<VisualOdometrySink> visual_odometry_;  ///< Null unless requested.
  PictureSink pictures_;
  Map3dSink map3d_;
  std::optional<std::string> memory_failure_;  ///< Why the vehicle's memory could not be written.
};

}  // namespace swiftlet::apps
