// swiftlet map3d: the trajectory and the coloured cloud of a recorded RGB-D camera.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/map3d_notes.hpp"
#include "apps/map3d_outputs.hpp"
#include "apps/map3d_run.hpp"
#include "apps/map3d_trust.hpp"
#include "apps/progress_line.hpp"
#include "apps/recorded_log.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "flight/system.hpp"
#include "flight/wall_clock.hpp"
#include "interfaces/clouds/point_cloud.hpp"
#include "interfaces/files/required.hpp"
#include "interfaces/files/tum.hpp"
#include "interfaces/files/unusable_folder.hpp"
#include "interfaces/rgbd/list_rgbd.hpp"
#include "interfaces/rgbd/rgbd_folder.hpp"
#include "mapping3d/cloud/cloud.hpp"
#include "mapping3d/model/map_resolution.hpp"
#include "mapping3d/model/submap_fusion.hpp"
#include "mapping3d/odometry/recorded_seeds.hpp"
#include "mapping3d/surface/surface_net.hpp"
#include "mapping3d/surface/tsdf_volume.hpp"
#include "mapping3d/voxels/point_voxels.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using common::Pose3;

/// One frame in this many, and one of its pixels in this many, are sampled for the typical depth of the scene.
constexpr std::uint64_t kDepthFrames = 10;
constexpr std::size_t kDepthPixels = 97;

struct Map3dOptions {
  std::string folder;
  std::string poses = "none";
  std::string intrinsics;
  std::string system = "swiftlet";
  std::string out;
  std::string mesh;
  std::optional<double> resolution_m;
  bool json = false;
};

/// Converts between `camera` and the recorder's camera, whose axes are those of image processing.
struct RecordedCamera {
  explicit RecordedCamera(const interfaces::RgbdCalibration& calibration)
      : T_camera_recorded(interfaces::T_camera_optical() * calibration.T_recorded_color().inverse()) {}

  Pose3 recorded(const Pose3& T_map_camera) const { return T_map_camera * T_camera_recorded; }
  Pose3 camera(const Pose3& T_world_recorded) const { return T_world_recorded * T_camera_recorded.inverse(); }

  Pose3 T_camera_recorded;
};

Pose3 T_map_camera(const Map3dRun& run, const TrackedFrame& frame) {
  return run.mapper.scans()->T_map_level(frame.scan) * frame.T_scan_camera;
}

/// The results are in the given poses' world. Without any, and for pieces that are not the map, they begin at the first
/// pose, whose axes are those of the recorder's camera.
Pose3 T_results_map(const Map3dRun& run, const MapPiece& piece) {
  if (run.anchor) {
    const TrackedFrame& frame = run.tracked[run.anchor->tracked];
    if (run.mapper.pieceOf(frame.scan) == piece.number)
      return run.anchor->T_world_camera * T_map_camera(run, frame).inverse();
  }
  return interfaces::T_camera_optical().inverse() * T_map_camera(run, piece.frames.front()).inverse();
}

/// nullopt if nothing was measured.
std::optional<double> medianDepth_m(const common::DepthImage& depth) {
  std::vector<float> measured_m;
  for (std::size_t i = 0; i < depth.depth_m.size(); i += kDepthPixels)
    if (common::isMeasured(depth.depth_m[i])) measured_m.push_back(depth.depth_m[i]);
  if (measured_m.empty()) return std::nullopt;
  const auto middle = measured_m.begin() + static_cast<std::ptrdiff_t>(measured_m.size() / 2);
  std::nth_element(measured_m.begin(), middle, measured_m.end());
  return *middle;
}

/// The newest tracked frames lose their poses.
void doubt(std::size_t frames, Map3dRun& run) {
  run.tracked.resize(run.tracked.size() - std::min(frames, run.tracked.size()));
  if (run.anchor && run.anchor->tracked >= run.tracked.size()) run.anchor.reset();
  run.lost += frames;
  run.doubted += frames;
}

void addFrame(const common::RgbdFrame& frame, common::Duration depth_later, mapping3d::RecordedSeeds& seeds,
              Map3dRun& run) {
  const auto begin = flight::Clock::now();
  const auto seed = seeds.at(frame.stamps.measured);
  const mapping3d::MappedFrame mapped = run.mapper.add(frame, {seed, nullptr, {}, depth_later});
  const mapping3d::RgbdPose& pose = mapped.pose;
  seeds.compare(pose);
  run.frame_ms.push_back(1e3 * flight::secondsSince(begin));
  if (run.frames % kDepthFrames == 0)
    if (const auto depth_m = medianDepth_m(frame.depth)) run.depths_m.push_back(*depth_m);
  const auto index = static_cast<double>(run.frames++);
  run.milliseconds.add(index, run.frame_ms.back());
  run.key_frames += pose.became_key_frame ? 1 : 0;
  run.with_pose += seed ? 1 : 0;
  if (!pose.isTracked()) {
    ++run.lost;
    doubt(static_cast<std::size_t>(pose.doubted), run);
    return;
  }
  if (mapped.begun) {
    run.tracked.push_back({mapped.begun->stamp, mapped.begun->scan, Pose3{}});
    --run.lost;
    ++run.key_frames;
  }
  if (seed && !run.anchor) run.anchor = WorldAnchor{run.tracked.size(), seed->T_map_camera};
  if (!run.tracked.empty()) run.disagreement.add(index, 1.0 - pose.fit.agreement);
  run.found_again += pose.state == mapping3d::TrackState::kFoundAgain ? 1 : 0;
  run.loops += static_cast<std::uint64_t>(mapped.loops);
  run.tracked.push_back({pose.stamp, pose.scan, mapped.T_scan_camera});
}

/// Of the recorder's camera, with all loop closures.
common::Trajectory trajectoryOf(const Map3dRun& run, const MapPiece& piece, const RecordedCamera& camera) {
  const Pose3 T_results = T_results_map(run, piece);
  common::Trajectory trajectory;
  for (const TrackedFrame& frame : piece.frames)
    trajectory.push_back({frame.stamp, T_results * camera.recorded(T_map_camera(run, frame))});
  return trajectory;
}

double pathLength_m(const common::Trajectory& trajectory) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    length_m += (trajectory[i].pose.position_m - trajectory[i - 1].pose.position_m).norm();
  return length_m;
}

/// The same poses, `factor` times as far apart in time.
common::Trajectory stretched(common::Trajectory trajectory, double factor) {
  if (factor == 1.0) return trajectory;  // A double has stamps of today only to some 100 ns.
  for (common::StampedPose& at : trajectory) at.stamp = common::Time::fromSeconds(factor * at.stamp.seconds());
  return trajectory;
}

/// In the stamps of the recording. Empty without given poses.
common::Trajectory givenPoses(const Map3dOptions& options) {
  if (options.poses == "none") return {};
  common::Trajectory poses =
      common::ordered(interfaces::readTum(options.poses, interfaces::StampOrder::kAny)).trajectory;
  if (poses.empty()) throw common::InputError({options.poses}, "", common::Message("poses.none", "holds no poses"));
  return poses;
}

/// Throws InputError if a frame would be where the octree of the results, map.bt, does not reach.
void requireInReach(const Map3dOptions& options, const common::Trajectory& poses, const interfaces::RgbdFolder& folder,
                    const mapping3d::VoxelConfig& voxels) {
  const double reach_m = mapping3d::octreeReach_m(voxels.resolution_m) - voxels.range_max_m;
  const auto gap = common::Duration::fromSeconds(mapping3d::RecordedSeeds::kLongestGap_s);
  for (const auto& pair : folder.listing().pairs) {
    const auto pose = common::poseAt(poses, pair.stamp, gap);
    if (!pose || pose->position_m.cwiseAbs().maxCoeff() < reach_m) continue;
    const Eigen::Vector3d& at_m = pose->position_m;
    throw common::InputError(
        {options.poses}, "",
        common::Message(
            "poses.out-of-reach",
            "places a frame at ({:.0f}, {:.0f}, {:.0f}) m, but the map reaches only {:.0f} m from the origin", at_m.x(),
            at_m.y(), at_m.z(), reach_m),
        "are the poses in metres? If so, subtract an offset from all of them");
  }
}

mapping3d::RecordedSeeds seedsOf(common::Trajectory poses, const RecordedCamera& camera) {
  for (common::StampedPose& at : poses) at.pose = camera.camera(at.pose);
  return mapping3d::RecordedSeeds(std::move(poses));
}

void mapFolder(interfaces::RgbdFolder& folder, const Map3dOptions& options, Map3dRun& run) {
  mapping3d::RecordedSeeds seeds = seedsOf(run.given, RecordedCamera(folder.calibration()));
  const auto begin = flight::Clock::now();
  ProgressLine line(options.json);
  while (const auto frame = folder.next()) {
    addFrame(*frame, folder.depthLater(), seeds, run);
    const double share = static_cast<double>(folder.passed()) / static_cast<double>(folder.listing().pairs.size());
    line.update(share,
                fmt::format("{}, {}, {} lost", plural(run.frames, "frame", "frames"),
                            plural(run.key_frames, "key frame", "key frames"), run.lost),
                flight::secondsSince(begin));
  }
  run.wall_s = flight::secondsSince(begin);
  run.disagreement_of_given = seeds.disagreement();
  line.close();
}

/// In the axes of the results, which the trajectory has too.
common::KeyPoses resultKeys(const Map3dRun& run, const MapPiece& piece) {
  common::KeyPoses keys = *run.mapper.scans();
  const Pose3 T_results = T_results_map(run, piece);
  for (common::KeyPose& key : keys.keys) key.T_map_camera = T_results * *key.T_map_camera;
  return keys;
}

Map3dMap resultsOf(const Map3dRun& run, const MapPiece& piece, const std::vector<common::Submap3d>& submaps) {
  const common::KeyPoses keys = resultKeys(run, piece);
  mapping3d::CloudConfig cloud;
  cloud.cube_m = run.config.submaps.cube_m;
  return {mapping3d::cloudOf(submaps, keys, cloud), mapping3d::fuse(submaps, keys, run.config.voxels.resolution_m)};
}

/// Whether voxels were forgotten for lack of memory: whole submaps, or parts of one, which then stays nearly full.
bool areVoxelsMissing(const std::vector<common::Submap3d>& submaps, const mapping3d::VoxelConfig& voxels) {
  const auto full = static_cast<std::size_t>(voxels.blocks_max) * 9 / 10;
  return !submaps.empty() && (submaps.front().first_frame > 0 ||
                              std::any_of(submaps.begin(), submaps.end(), [&](const common::Submap3d& submap) {
                                return submap.voxels->blockCount() >= full;
                              }));
}

/// Reads the recording again, when all loops are closed: each frame of the piece is drawn where it is at the end.
mapping3d::TsdfVolume volumeOf(const interfaces::RgbdListing& listing, const Map3dRun& run, const MapPiece& piece,
                               ProgressLine& line) {
  const common::KeyPoses keys = resultKeys(run, piece);
  mapping3d::TsdfVolume volume({run.config.submaps.cube_m, run.config.submaps.point_range_m});
  interfaces::RgbdFolder folder(listing);
  const auto begin = flight::Clock::now();
  auto tracked = piece.frames.begin();
  while (tracked != piece.frames.end()) {
    const auto frame = folder.next();
    if (!frame) break;
    if (frame->stamps.measured != tracked->stamp) continue;
    volume.integrate(*frame, keys.T_map_level(tracked->scan) * tracked->T_scan_camera);
    ++tracked;
    line.update(static_cast<double>(tracked - piece.frames.begin()) / static_cast<double>(piece.frames.size()),
                "drawing the mesh", flight::secondsSince(begin));
  }
  return volume;
}

/// "." has a name, too.
fs::path wholePath(const std::string& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

/// Whether the mesh is written into the folder of the results.
bool isResult(const std::string& mesh, const fs::path& out) {
  return !mesh.empty() && wholePath(mesh).parent_path() == wholePath(out);
}

ResultsKind resultsWith(const std::string& mesh, const fs::path& out) {
  ResultsKind kind = kMap3dResults;
  const std::string name = fs::path(mesh).filename().string();
  if (isResult(mesh, out) && std::find(kind.files.begin(), kind.files.end(), name) == kind.files.end())
    kind.files.push_back(name);
  return kind;
}

void writeSurface(const Map3dOptions& options, const interfaces::RgbdListing& listing, const ResultsFolder& results,
                  const MapPiece& piece, Map3dRun& run, std::vector<std::string>& notes) {
  ProgressLine line(options.json);
  const mapping3d::TsdfVolume volume = volumeOf(listing, run, piece, line);
  const common::SurfaceMesh mesh = mapping3d::surfaceNet(volume);
  run.triangles = mesh.triangles.size();
  const fs::path file = options.mesh;
  interfaces::required(interfaces::writeMesh(
      isResult(options.mesh, results.path()) ? results.unfinished() / file.filename() : file, mesh));
  line.close();
  if (volume.range_m() < run.config.submaps.point_range_m)
    notes.push_back(
        fmt::format("the mesh has surfaces up to {:.1f} m from the camera: farther ones are too noisy for "
                    "voxels of {:g} m",
                    volume.range_m(), volume.resolution_m()));
  if (volume.isFull())
    notes.emplace_back("the mesh is not complete: it would need too much memory at this --resolution");
}

/// Of each piece, the map first.
nlohmann::ordered_json piecesJson(const std::vector<MapPiece>& pieces) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const MapPiece& piece : pieces)
    list.push_back({{"frames", piece.frames.size()},
                    {"from_s", piece.frames.front().stamp.seconds()},
                    {"to_s", piece.frames.back().stamp.seconds()}});
  return list;
}

nlohmann::ordered_json figuresOf(const Map3dOptions& options, const interfaces::RgbdFolder& folder, const Map3dRun& run,
                                 const std::vector<MapPiece>& pieces, const Map3dTrust& trust, double path_length_m,
                                 const std::vector<std::string>& notes, const fs::path& out) {
  return {{"folder", options.folder},
          {"format", folder.listing().format},
          {"out", out.string()},
          {"trusted", trust.reason.empty()},
          {"trust_reason", trust.reason},
          {"frames", run.frames},
          {"skipped_frames", folder.skipped()},
          {"unpaired_images", folder.listing().unpaired},
          {"frames_with_pose", run.with_pose},
          {"lost_frames", run.lost},
          {"doubted_frames", run.doubted},
          {"pieces", piecesJson(pieces)},
          {"found_again", run.found_again},
          {"key_frames", run.key_frames},
          {"loops", run.loops},
          {"places_seen_twice", trust.contradiction.seen_twice},
          {"contradiction", std::round(1e4 * trust.contradiction.share()) / 1e4},
          {"path_length_m", path_length_m},
          {"mesh_triangles", run.triangles},
          {"milliseconds_a_frame", run.medianMs()},
          {"seconds", run.wall_s},
          {"notes", notes}};
}

/// Throws InputError before the recording is mapped.
void requireMeshFile(const std::string& file, const fs::path& out) {
  if (file.empty()) return;
  if (!interfaces::isMeshName(file))
    throw common::InputError({file}, "--mesh", common::Message("map3d.mesh-ending", "is not named .ply or .obj"));
  if (!isResult(file, out)) interfaces::requireWritableFolder(fs::absolute(file).parent_path(), "--mesh");
}

mapping3d::Mapper3dConfig configOf(const Map3dOptions& options) {
  auto config = mapping3d::configOfRecordings(
      flight::loadSystem(options.system).config.autonomy.estimator.rgbd.mapper.odometry.method);
  if (options.resolution_m) mapping3d::setResolution(*options.resolution_m, config);
  return config;
}

std::vector<std::pair<std::string, std::string>> factsOf(const Map3dOptions& options,
                                                         const interfaces::RgbdFolder& folder, const Map3dRun& run,
                                                         std::size_t pieces, const Map3dTrust& trust,
                                                         double path_length_m) {
  std::vector<std::pair<std::string, std::string>> facts{{"trusted", trust.reason.empty() ? "yes" : "no"},
                                                         {"format", folder.listing().format},
                                                         {"frames", fmt::format("{}", run.frames)},
                                                         {"skipped", fmt::format("{}", folder.skipped())}};
  if (!run.given.empty()) facts.emplace_back("with a pose", fmt::format("{}", run.with_pose));
  facts.insert(facts.end(), {{"lost", fmt::format("{}", run.lost)},
                             {"pieces", fmt::format("{}", pieces)},
                             {"key frames", fmt::format("{}", run.key_frames)},
                             {"loop closures", fmt::format("{}", run.loops)},
                             {"path length", fmt::format("{:.2f} m", path_length_m)},
                             {"time a frame", fmt::format("{:.1f} ms", run.medianMs())},
                             {"computing time", fmt::format("{:.1f} s", run.wall_s)}});
  if (!options.mesh.empty())
    facts.emplace_back("mesh", fmt::format("{}, {}", options.mesh, plural(run.triangles, "triangle", "triangles")));
  return facts;
}

int map3d(const Map3dOptions& options) {
  interfaces::RgbdFolder folder(interfaces::listRgbdFolder(options.folder, options.intrinsics));
  const fs::path recording = wholePath(options.folder);
  const std::string name = (fs::is_directory(recording) ? recording.filename() : recording.stem()).string();
  const fs::path out = options.out.empty() ? name + "-map3d" : options.out;
  requireMeshFile(options.mesh, out);
  ResultsFolder results(out, resultsWith(options.mesh, out));
  Map3dRun run(configOf(options));
  const double rate_Hz = folder.listing().stamps_per_s;
  run.given = stretched(givenPoses(options), 1.0 / rate_Hz);
  requireInReach(options, run.given, folder, run.config.voxels);
  mapFolder(folder, options, run);
  const std::vector<MapPiece> pieces = run.pieces();
  const Map3dTrust trust = map3dTrust(run, pieces);
  Map3dFigures shown{
      recording.string(), {}, map3dNotes(folder, run, pieces, trust), run.milliseconds, run.disagreement};
  if (run.tracked.empty()) {
    for (const std::string& warning : shown.warnings) showError(warning + "\n");
    throw common::InputError({options.folder}, "",
                             common::Message("rgbd.none-usable", "of {} none can be used",
                                             plural(folder.listing().pairs.size(), "frame", "frames")),
                             map3dRemedy(folder, run));
  }
  std::vector<common::Trajectory> trajectories;
  for (const MapPiece& piece : pieces)
    trajectories.push_back(stretched(trajectoryOf(run, piece, RecordedCamera(folder.calibration())), rate_Hz));
  const double path_length_m = pathLength_m(trajectories.front());
  if (!options.mesh.empty()) writeSurface(options, folder.listing(), results, pieces.front(), run, shown.warnings);
  shown.facts = factsOf(options, folder, run, pieces.size(), trust, path_length_m);
  const std::vector<common::Submap3d> submaps = run.submapsOf(pieces.front());
  if (areVoxelsMissing(submaps, run.config.voxels))
    shown.warnings.emplace_back("map.bt is not complete: it would need too much memory at this --resolution");
  ProgressLine line(options.json);
  line.update("100 %  making the cloud, the octree and the report", run.wall_s);
  writeMap3dOutputs(results.unfinished(), trajectories, resultsOf(run, pieces.front(), submaps), shown);
  results.publish();
  line.close();
  if (options.json) {
    const auto figures = figuresOf(options, folder, run, pieces, trust, path_length_m, shown.warnings, results.path());
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
                   "Frames in the format of TUM RGB-D (rgb.txt and depth.txt, or associations.txt), of 7-Scenes or "
                   "tsdf-fusion (frame-000000.color.png, .depth.png; camera-intrinsics.txt), of Open3D, Redwood or "
                   "ScanNet (color/, depth/; camera_intrinsic.json, intrinsic/intrinsic_depth.txt), or a rosbag 1 with "
                   "images, depths and CameraInfo.");
  command.option("--poses", options->poses,
                 "Poses of the camera from other sensors, to begin each alignment with: TUM (t x y z qx qy qz qw), or "
                 "none.");
  command.option(
      "--intrinsics", options->intrinsics,
      "Calibration of the camera (YAML), as far as it differs from that of the recording or of the format. Default: "
      "calibration.yaml of the folder, if there is one.");
  command.option("--system", options->system,
                 "A profile of config/systems, or a file: the method that finds the pose of a frame.");
  command.option("--out", options->out, "Folder for the results. NAME-map3d when not given.");
  command.option(
      "--resolution", options->resolution_m, {0.005, 0.5},
      "Side of voxels and of the cubes of points, in metres. Default: 0.05 for map.bt, 0.02 for cloud.ply and "
      "the mesh. Fine voxels reach only as far as depths are that precise: 1.9 m at 0.005.");
  command.option("--mesh", options->mesh,
                 "Also write the surfaces as coloured triangles to this file, .ply or .obj. Reads the frames twice.");
  command.flag("--json", options->json, "Print the figures as JSON.");
  command.footer(
      "trajectory.tum has the poses of the camera with x right, y down and z along the view, as the ground truth of\n"
      "both formats has them; the map begins at the first pose of the colour camera, or is in the world of --poses.\n"
      "Where a lost camera began pieces of the map that nothing connects to it, pieces.txt has the poses of all "
      "pieces.\n"
      "Example: swiftlet map3d rgbd_dataset_freiburg1_desk --out desk");
  command.runs([options] { return map3d(*options); });
}

}  // namespace swiftlet::apps
