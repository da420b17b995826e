// What is kept of one vehicle's flight: its run folder with pictures, maps and logs.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flight/control_log_sink.hpp"
#include "flight/flight_setup.hpp"
#include "flight/flight_sinks.hpp"
#include "flight/map3d_sink.hpp"
#include "flight/picture_sink.hpp"
#include "flight/recognition_sink.hpp"
#include "flight/rgbd_sink.hpp"
#include "interfaces/run_folder.hpp"

namespace swiftlet::flight {

/// One thread. Refers to its setup, and to the reference (may be null) until the flight is over.
class RunRecord {
 public:
  /// Throws common::InputError for a folder that cannot be used.
  RunRecord(const FlightSetup& setup, interfaces::RunInfo info, const std::filesystem::path& folder,
            const MotionReference* reference);

  /// The pictures come last: they show what the others have written.
  std::vector<autonomy::FlightSink*> sinks();
  /// Null unless requested.
  perception::FilterListener* filterListener() { return control_log_.get(); }
  const interfaces::RunFolder& folder() const { return folder_; }

  /// After the last tick: the pictures, the 3D map and the logs of the end.
  void writeLast(const common::World& world);
  /// Writes the rest, and what was learned if the setup asks for it. Call it once, as the last call.
  void finish(const autonomy::VehicleMemory& learned, interfaces::FlightEnd end);
  /// Why something could not be written; nullopt without a failure.
  std::optional<std::string> failure() const;

 private:
  void keepMemory(const autonomy::VehicleMemory& learned, interfaces::FlightEnd& end);

  const FlightSetup& setup_;
  interfaces::RunFolder folder_;
  FolderSink folder_sink_;
  std::unique_ptr<ControlLogSink> control_log_;  ///< Null unless requested.
  std::unique_ptr<RgbdSink> rgbd_;               ///< Null unless requested.
  PictureSink pictures_;
  Map3dSink map3d_;
  RecognitionSink recognition_;
  std::optional<std::string> memory_failure_;  ///< Why the vehicle's memory could not be written.
};

}  // namespace swiftlet::flight
