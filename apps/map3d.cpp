// swiftlet map3d: the trajectory and the coloured cloud of a recorded RGB-D camera.
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/map3d_outputs.hpp"
#include "apps/progress_line.hpp"
#include "apps/recorded_log.hpp"
#include "apps/show.hpp"
#include "apps/wall_clock.hpp"
#include "common/error.hpp"
#include "interfaces/files/tum.hpp"
#include "interfaces/rgbd/rgbd_folder.hpp"
#include "mapping3d/cloud/cloud.hpp"
#include "mapping3d/model/mapper3d.hpp"
#include "mapping3d/model/submap_fusion.hpp"
#include "mapping3d/odometry/recorded_seeds.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using common::Pose3;
using interfaces::FrameFault;

/// With poses for a smaller part of the frames, their times are probably those of another clock.
constexpr double kFewPoses = 0.5;
/// A map of which more than this part was lost is probably not one map.
constexpr double kMostLost = 0.1;

struct Map3dOptions {
  std::string folder;
  std::string poses = "none";
  std::string intrinsics;
  std::string out;
  bool mesh = false;
  bool json = false;
};

/// A frame relative to a key frame, so that later loop closures move it.
struct TrackedFrame {
  common::Time stamp;
  int scan = 0;
  Pose3 T_scan_camera;
};

struct Map3dRun {
  mapping3d::Mapper3d mapper{mapping3d::Mapper3dConfig()};
  std::vector<TrackedFrame> tracked;
  bool begins_at_pose = false;  ///< The map is in the world of the given poses: its first frame had one.
  common::Trajectory given;     ///< Poses of the recorder's camera from other sensors.
  std::uint64_t with_pose = 0;  ///< Frames with a given pose of their time.
  rendering::ThinnedCurve milliseconds, disagreement;
  std::vector<double> frame_ms;
  std::uint64_t frames = 0, lost = 0, found_again = 0, key_frames = 0, loops = 0;
  double wall_s = 0.0;

  double medianMs() {
    std::sort(frame_ms.begin(), frame_ms.end());
    return frame_ms.empty() ? 0.0 : frame_ms[frame_ms.size() / 2];
  }
};

/// Converts between `camera` and the recorder's camera, whose axes are those of image processing.
struct RecordedCamera {
  explicit RecordedCamera(const interfaces::RgbdCalibration& calibration)
      : T_camera_recorded(interfaces::T_camera_optical() * calibration.T_recorded_color().inverse()) {}

  Pose3 recorded(const Pose3& T_map_camera) const { return T_map_camera * T_camera_recorded; }
  Pose3 camera(const Pose3& T_world_recorded) const { return T_world_recorded * T_camera_recorded.inverse(); }

  Pose3 T_camera_recorded;
};

/// The results have the axes of the given poses' world. Without any, the map begins at the first pose, whose axes are
/// those of `camera` in the map and those of the recorder's camera in the results.
Pose3 T_results_map(const Map3dRun& run) {
  return run.begins_at_pose ? Pose3{} : interfaces::T_camera_optical().inverse();
}

void addFrame(const common::RgbdFrame& frame, mapping3d::RecordedSeeds& seeds, Map3dRun& run) {
  const auto begin = Clock::now();
  const auto seed = seeds.at(frame.stamps.measured);
  const mapping3d::MappedFrame mapped = run.mapper.add(frame, {seed, nullptr, {}});
  const mapping3d::RgbdPose& pose = mapped.pose;
  seeds.compare(pose);
  run.frame_ms.push_back(1e3 * secondsSince(begin));
  const auto index = static_cast<double>(run.frames++);
  run.milliseconds.add(index, run.frame_ms.back());
  run.key_frames += pose.became_key_frame ? 1 : 0;
  run.with_pose += seed ? 1 : 0;
  if (!pose.isTracked()) {
    ++run.lost;
    return;
  }
  if (run.tracked.empty()) run.begins_at_pose = seed.has_value();
  if (run.frames > 1) run.disagreement.add(index, 1.0 - pose.fit.agreement);
  run.found_again += pose.state == mapping3d::TrackState::kFoundAgain ? 1 : 0;
  run.loops += static_cast<std::uint64_t>(mapped.loops);
  run.tracked.push_back({pose.stamp, pose.scan, mapped.T_scan_camera});
}

/// Of the recorder's camera, with all loop closures.
common::Trajectory trajectoryOf(const Map3dRun& run, const RecordedCamera& camera) {
  const auto keys = run.mapper.scans();
  common::Trajectory trajectory;
  for (const TrackedFrame& frame : run.tracked)
    trajectory.push_back(
        {frame.stamp, T_results_map(run) * camera.recorded(keys->T_map_level(frame.scan) * frame.T_scan_camera)});
  return trajectory;
}

double pathLength_m(const common::Trajectory& trajectory) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    length_m += (trajectory[i].pose.position_m - trajectory[i - 1].pose.position_m).norm();
  return length_m;
}

/// Empty where none are given.
common::Trajectory givenPoses(const Map3dOptions& options) {
  if (options.poses == "none") return {};
  return common::ordered(interfaces::readTum(options.poses, interfaces::StampOrder::kAny)).trajectory;
}

mapping3d::RecordedSeeds seedsOf(common::Trajectory poses, const RecordedCamera& camera) {
  for (common::StampedPose& at : poses) at.pose = camera.camera(at.pose);
  return {std::move(poses), {}};
}

void mapFolder(interfaces::RgbdFolder& folder, const Map3dOptions& options, Map3dRun& run) {
  mapping3d::RecordedSeeds seeds = seedsOf(run.given, RecordedCamera(folder.calibration()));
  const auto begin = Clock::now();
  ProgressLine line(options.json);
  while (const auto frame = folder.next()) {
    addFrame(*frame, seeds, run);
    line.update(
        fmt::format("{:3.0f} %  {}, {}, {} lost",
                    100.0 * static_cast<double>(folder.passed()) / static_cast<double>(folder.listing().pairs.size()),
                    plural(run.frames, "frame", "frames"), plural(run.key_frames, "key frame", "key frames"), run.lost),
        secondsSince(begin));
  }
  run.wall_s = secondsSince(begin);
  line.close();
}

/// In the axes of the results, which the trajectory has too.
Map3dMap resultsOf(Map3dRun& run) {
  common::KeyPoses keys = *run.mapper.scans();
  for (common::KeyPose& key : keys.keys) key.T_map_camera = T_results_map(run) * *key.T_map_camera;
  const std::vector<common::Submap3d> submaps = run.mapper.submaps();
  const double resolution_m = mapping3d::VoxelConfig().resolution_m;
  return {mapping3d::cloudOf(submaps, keys), mapping3d::fuse(submaps, keys, resolution_m)};
}

/// What is to be said of the given poses; empty if most frames have one.
std::string noteOnPoses(const interfaces::RgbdFolder& folder, const Map3dRun& run) {
  if (run.given.empty() || static_cast<double>(run.with_pose) >= kFewPoses * static_cast<double>(run.frames)) return {};
  const auto& pairs = folder.listing().pairs;
  return fmt::format("{}: the poses are from {:.3f} s to {:.3f} s, the frames from {:.3f} s to {:.3f} s",
                     run.with_pose == 0 ? std::string("no frame has a pose of its time")
                                        : fmt::format("only {} of {} have a pose of their time", run.with_pose,
                                                      plural(run.frames, "frame", "frames")),
                     run.given.front().stamp.seconds(), run.given.back().stamp.seconds(), pairs.front().stamp.seconds(),
                     pairs.back().stamp.seconds());
}

std::vector<std::string> warningsOf(const interfaces::RgbdFolder& folder, const Map3dRun& run) {
  std::vector<std::string> warnings;
  if (static_cast<double>(run.lost) > kMostLost * static_cast<double>(run.frames))
    warnings.push_back("the map is probably wrong: much of the track was lost");
  if (run.lost > 0)
    warnings.push_back(fmt::format("the track was lost for {} and found again {}", plural(run.lost, "frame", "frames"),
                                   plural(run.found_again, "time", "times")));
  if (const auto factor = run.mapper.betterFocalFactor())
    warnings.push_back(fmt::format(
        "the map is probably wrong: the frames fit each other better with {:.2f} times the focal length; check the "
        "calibration (--intrinsics)",
        *factor));
  if (std::string note = noteOnPoses(folder, run); !note.empty()) warnings.push_back(std::move(note));
  if (folder.listing().unpaired > 0)
    warnings.push_back(plural(folder.listing().unpaired, "image has", "images have") + " no partner of the same time");
  for (std::size_t i = 0; i < interfaces::kFrameFaults; ++i) {
    const auto fault = static_cast<FrameFault>(i);
    if (folder.skipped(fault) > 0)
      warnings.push_back(fmt::format("{} skipped: {}; the first: {}",
                                     plural(folder.skipped(fault), "frame was", "frames were"),
                                     interfaces::toString(fault), folder.firstDetail(fault)));
  }
  return warnings;
}

nlohmann::ordered_json figuresOf(const Map3dOptions& options, const interfaces::RgbdFolder& folder, Map3dRun& run,
                                 double path_length_m, const std::vector<std::string>& notes, const fs::path& out) {
  return {{"folder", options.folder},
          {"format", folder.listing().format},
          {"out", out.string()},
          {"frames", run.frames},
          {"skipped_frames", folder.skipped()},
          {"unpaired_images", folder.listing().unpaired},
          {"frames_with_pose", run.with_pose},
          {"lost_frames", run.lost},
          {"found_again", run.found_again},
          {"key_frames", run.key_frames},
          {"loops", run.loops},
          {"path_length_m", path_length_m},
          {"milliseconds_a_frame", run.medianMs()},
          {"seconds", run.wall_s},
          {"notes", notes}};
}

int map3d(const Map3dOptions& options) {
  interfaces::RgbdFolder folder(interfaces::listRgbdFolder(options.folder, options.intrinsics));
  fs::path name = fs::path(options.folder).lexically_normal();
  if (!name.has_filename()) name = name.parent_path();
  ResultsFolder results(options.out.empty() ? fs::path(name.filename().string() + "-map3d") : fs::path(options.out),
                        kMap3dResults);
  Map3dRun run;
  run.given = givenPoses(options);
  mapFolder(folder, options, run);
  Map3dFigures shown{options.folder, {}, warningsOf(folder, run), run.milliseconds, run.disagreement};
  if (run.tracked.empty()) {
    for (const std::string& warning : shown.warnings) showError(warning + "\n");
    throw common::InputError(common::Problem{
        {options.folder},
        "",
        fmt::format("of {} none can be used", plural(folder.listing().pairs.size(), "frame", "frames")),
        "the notes above say why; a frame needs a depth image of the size of its picture, with depths in most of it"});
  }
  const common::Trajectory trajectory = trajectoryOf(run, RecordedCamera(folder.calibration()));
  const double path_length_m = pathLength_m(trajectory);
  shown.facts = {{"format", folder.listing().format},
                 {"frames", fmt::format("{}", run.frames)},
                 {"skipped", fmt::format("{}", folder.skipped())},
                 {"lost", fmt::format("{}", run.lost)},
                 {"key frames", fmt::format("{}", run.key_frames)},
                 {"loop closures", fmt::format("{}", run.loops)},
                 {"path length", fmt::format("{:.2f} m", path_length_m)},
                 {"time a frame", fmt::format("{:.1f} ms", run.medianMs())},
                 {"computing time", fmt::format("{:.1f} s", run.wall_s)}};
  if (!run.given.empty())
    shown.facts.insert(shown.facts.begin() + 3, {"with a pose", fmt::format("{}", run.with_pose)});
  writeMap3dOutputs(results.unfinished(), trajectory, resultsOf(run), shown, options.mesh);
  results.publish();
  if (options.json) {
    const auto figures = figuresOf(options, folder, run, path_length_m, shown.warnings, results.path());
    showJson(figures.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    return kDone;
  }
  for (const std::string& warning : shown.warnings) show("note: " + warning + "\n");
  for (const auto& [label, value] : shown.facts) show(fmt::format("{:<14} {}\n", label, value));
  show(fmt::format("{}\n", (results.path() / "report.html").string()));
  return kDone;
}

}  // namespace

void addMap3d(Command& program) {
  auto options = std::make_shared<Map3dOptions>();
  Command command = program.command("map3d", "Make the 3D map of a recorded RGB-D camera.");
  command.argument("folder", options->folder,
                   "Frames in the format of TUM RGB-D (rgb.txt and depth.txt, or associations.txt) or of 7-Scenes "
                   "(frame-000000.color.png, .depth.png).");
  command.option("--poses", options->poses,
                 "Poses of the camera from other sensors, to begin each alignment with: TUM (t x y z qx qy qz qw), or "
                 "none.");
  command.option("--intrinsics", options->intrinsics,
                 "Calibration of the camera (YAML), as far as it differs from the usual one of the format. Default: "
                 "calibration.yaml of the folder, if there is one.");
  command.option("--out", options->out, "Folder for the results. NAME-map3d when not given.");
  command.flag("--mesh", options->mesh, "Also write mesh.ply, the surfaces of the map as coloured triangles.");
  command.flag("--json", options->json, "Print the figures as JSON.");
  command.footer(
      "trajectory.tum has the poses of the camera with x right, y down and z along the view, as the ground truth of\n"
      "both formats has them; the map begins at the first pose of the colour camera, or is in the world of --poses.\n"
      "Example: swiftlet map3d rgbd_dataset_freiburg1_desk --out desk");
  command.runs([options] { return map3d(*options); });
}

}  // namespace swiftlet::apps
