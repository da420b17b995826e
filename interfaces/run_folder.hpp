// The folder of a run. It is readable at every moment of the flight, also after the process was killed.
//
//   mission.json     outcome, times, distance, phases, frontiers with reasons, figures; "flying" until the end
//   events.jsonl     every event as it happens
//   trajectory.tum   the estimate in `map`
//   ground_truth.tum   the true trajectory of a simulated vehicle in `map`, while airborne; written at the end
//   trajectory_given.tum   the pose in the given map, if there is one, while localized
//   trajectory_camera.tum   with an RGB-D camera: the poses in `map` of the frames that were aligned to the 3D map,
//                    with x right, y down and z along the view, as TUM RGB-D has them
//   cloud.ply, map.bt, map.ot     with an RGB-D camera: the 3D map, replaced every few seconds and at the end
//   map.pgm, map.yaml, map.png    replaced whole every few seconds and at the end
//   map-NAME.pgm, map-NAME.yaml    each map that the mission saved
//   photo-NN-NAME.jpg, photo-NN-NAME.json    each photograph of the mission, and where the camera was
//   objects.json, object-NN-WHAT.jpg     where something is recognized: poses with covariances, and a picture of each
//   topological_map.yaml    places, passages and danger zones (common/topological_map.hpp); written at the end
//   report.html      the same in one page
//   config.yaml      the settings in force
//   vehicle.yaml, laser.yaml, rgbd_camera.yaml, vertical_laser.yaml, vehicle_model.yaml
//                    what config.yaml names and is not shipped
//   vehicle_memory_read.yaml, vehicle_memory_learned.yaml    of a flight with a vehicle's memory: before and after it
//   control.tsv      with --control-log: commands, motion and battery at 100 Hz (interfaces/control_log.hpp)
//   rgbd/            with --record-rgbd: the frames of the RGB-D camera (interfaces/rgbd/rgbd_recorder.hpp)
//   fusion.tsv       with --control-log: all inputs of the fusion filter (perception/fusion/filter_tape.hpp)
//   nature.yaml      the true plant values of a simulated vehicle; no file if none was drawn
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/event.hpp"
#include "common/geometry.hpp"
#include "common/machine_use.hpp"
#include "common/occupancy_grid.hpp"
#include "common/rgbd_frame.hpp"
#include "common/trajectory.hpp"
#include "common/vehicle_state.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/flight_summary.hpp"
#include "interfaces/report/report.hpp"

namespace swiftlet::common {
struct World;
struct TopologicalMap;
}  // namespace swiftlet::common

namespace swiftlet::interfaces {

/// Makes a new folder below `parent`: STARTED-MISSION, with a number if that name is taken, also by a flight that
/// starts at the same moment. Characters that are not allowed in file names become `-`. Throws common::InputError.
std::filesystem::path freshRunFolder(const std::filesystem::path& parent, const std::string& started,
                                     const std::string& mission);

/// How the flight ended, from the caller.
struct FlightEnd {
  Outcome outcome = Outcome::kDone;
  std::string reason;
  std::optional<double> coverage;
  std::vector<Figure> figures;
  std::optional<double> wall_time_s;
  common::Trajectory ground_truth_map = {};  ///< In the `map` frame; empty if it is not known.
  std::string vehicle_memory_yaml = {};      ///< The vehicle's memory after the flight; empty: it is not kept.
  common::MachineUse machine = {};
};

/// What became of some files of the 3D map: they are large, and another thread than the folder's writes them.
struct Map3dWritten {
  Written written;
  /// When submaps and poses were those that map.bt and map.ot are fused from; nullopt if those are unchanged.
  std::optional<common::Time> octree_stamp = {};
};

/// Used by one thread. Nothing throws after the constructor. If something cannot be written (full disk), the reason is
/// kept in `failure`, writing stops, and the caller decides; no file is left half written.
class RunFolder {
 public:
  /// Makes the folder. An existing one must be empty or an older run, whose files are removed first. Anything else is
  /// refused, also a folder that another flight writes. Throws common::InputError with the reason.
  RunFolder(std::filesystem::path path, RunInfo info, std::string config_yaml);
  ~RunFolder();
  RunFolder(RunFolder&&) noexcept;
  RunFolder& operator=(RunFolder&&) noexcept;

  /// Call at every estimate.
  void state(const common::VehicleState& state);
  /// Call at every event, in order.
  void event(const common::Event& event);
  /// Call at every snapshot.
  void world(const common::World& world);
  /// Writes the map as map-NAME.pgm and map-NAME.yaml; a later one of that name replaces it.
  void saveMap(const std::string& name, const common::OccupancyGrid& grid);
  /// Writes the picture, with a number that counts from 1, and the pose of the camera.
  void savePhoto(const std::string& name, const common::RgbdFrame& frame, const common::Pose3& T_map_camera);
  /// Writes a JPEG of a recognized object, drawn in.
  void saveObjectPicture(const common::RecognizedObject& object, const std::vector<std::uint8_t>& jpeg);
  /// Writes topological_map.yaml.
  void savePlaces(const common::TopologicalMap& map);
  /// The pictures of the next report and map.png; may be called repeatedly.
  void show(ReportPictures pictures);
  /// Call after files of the 3D map were written into path(), or could not be.
  void wroteMap3d(const Map3dWritten& result);
  /// Writes the last map, mission.json and report, safe from a power cut. Call it once, as the last call. It tries
  /// everything even if something failed before.
  void finish(const FlightEnd& end);

  const std::filesystem::path& path() const;
  /// The summary so far; after `finish` that of the whole flight.
  const FlightSummary& summary() const;
  /// Why something could not be written; nullopt without a failure.
  const std::optional<std::string>& failure() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::interfaces
