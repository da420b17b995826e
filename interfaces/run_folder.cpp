#include "interfaces/run_folder.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>

#include <fmt/format.h>

#include "common/base64.hpp"
#include "common/error.hpp"
#include "common/jpeg_encoder.hpp"
#include "common/topological_map.hpp"
#include "common/world.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/objects_layer.hpp"
#include "common/world/targets_layer.hpp"
#include "common/world/vehicle_layer.hpp"
#include "interfaces/files/json_lines.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/tum.hpp"
#include "interfaces/files/unusable_folder.hpp"
#include "interfaces/rgbd/rgbd_calibration.hpp"
#include "interfaces/run_files.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;
using common::Duration;
using common::InputError;
using common::Message;
using common::MissionState;
using common::Time;

/// Between two versions of map, mission.json and report.
constexpr Duration kMapPeriod = Duration::fromMilliseconds(3000);
constexpr Duration kTrajectoryPeriod = Duration::fromMilliseconds(40);  ///< Between two poses of trajectory.tum.
constexpr Duration kSamplePeriod = Duration::fromMilliseconds(200);     ///< Between two samples for plots.

template <typename Writer>
Writer opened(tl::expected<Writer, FileError> writer) {
  if (!writer) throw InputError({}, "", writer.error().message);
  return std::move(*writer);
}

/// True for the first call and then once a period. It keeps to the lattice of periods, so that late calls do not add
/// up.
class Every {
 public:
  explicit Every(Duration period) : period_(period) {}
  bool due(Time now) {
    if (next_ && now < *next_) return false;
    next_ = next_ && now - *next_ < period_ ? *next_ + period_ : now + period_;
    return true;
  }

 private:
  Duration period_;
  std::optional<Time> next_;
};

FlightSample sampleOf(const common::World& world) {
  const common::VehicleState& state = world.vehicle->state;
  FlightSample sample;
  sample.time_s = world.stamp.seconds();
  sample.position_map_m = state.T_map_body().position_m;
  sample.speed_m_s = state.velocity_odom_m_s.head<2>().norm();
  sample.height_above_ground_m = state.height_above_ground_m;
  sample.battery_v = world.energy->battery_voltage_v;
  sample.explored_area_m2 = world.map->explored_area_m2;
  sample.nearest_m = world.vehicle->avoidance.nearest_m;
  return sample;
}

}  // namespace

fs::path freshRunFolder(const fs::path& parent, const std::string& started, const std::string& mission) {
  std::string name = started + "-" + mission;
  for (char& c : name) {
    const bool good =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
    if (!good) c = '-';
  }
  fs::path path = parent / name;
  try {
    fs::create_directories(parent);
    for (int number = 2; !fs::create_directory(path); ++number) path = parent / fmt::format("{}-{}", name, number);
  } catch (const fs::filesystem_error& e) {
    throw InputError(unusableFolder(path, e.code()));
  }
  return path;
}

struct RunFolder::Impl {
  Impl(fs::path folder, RunInfo info, std::string yaml)
      : path(std::move(folder)),
        lock(claimedRunFolder(path)),
        config_yaml(std::move(yaml)),
        events_file(opened(EventWriter::create(clearedRunFolder(path) / "events.jsonl"))),
        trajectory_file(opened(TumWriter::create(path / "trajectory.tum"))),
        trajectory_due(kTrajectoryPeriod),
        sample_due(kSamplePeriod),
        map_due(kMapPeriod) {
    summary.info = std::move(info);
  }

  void keep(const Written& written) {
    if (!written && !failure) failure = written.error().message.text();
  }

  void write(const char* name, std::string_view bytes, Durability durability = Durability::kProcess) {
    keep(writeAtomically(path / name, bytes, durability));
  }

  void writeSummary(Durability durability = Durability::kProcess) {
    if (octree_stamp) summary.octree_age_s = (last_snapshot - *octree_stamp).seconds();
    write("mission.json", toJson(summary), durability);
    if (recognizes) write("objects.json", objectsJson(summary.objects), durability);
    write("report.html", flightReport(summary, events, pictures, config_yaml), durability);
  }

  void track(const common::World& world);
  void localize(const common::World& world);
  void beginGiven(const std::shared_ptr<const common::GivenMap>& map);
  void followCamera(const common::World& world);
  void writeTruth(const common::Trajectory& truth_map);

  fs::path path;
  FolderLock lock;
  std::string config_yaml;
  EventWriter events_file;
  TumWriter trajectory_file;
  std::optional<TumWriter> given_trajectory_file, camera_trajectory_file;
  std::shared_ptr<const common::GivenMap> given;  ///< The map in which the file's poses lie.
  Time camera_stamp;                              ///< Of the last frame in its file.
  Every trajectory_due, sample_due, map_due;
  FlightSummary summary;
  std::vector<common::Event> events;
  ReportPictures pictures;
  std::shared_ptr<const common::OccupancyGrid> grid;
  std::optional<Time> mission_begin, last_flown;
  bool mission_over = false;
  Time last_snapshot;
  std::optional<Time> octree_stamp;
  int photos = 0;
  bool recognizes = false;  ///< The World has a layer of objects.
  std::optional<std::string> failure;
};

/// Updates the summary from the flight: its figures, and its phases in the mission's own words.
void RunFolder::Impl::track(const common::World& world) {
  summary.distance_m = world.vehicle->distance_flown_m;
  if (world.map->explored_area_m2 > 0) summary.explored_area_m2 = world.map->explored_area_m2;
  summary.battery_remaining = world.energy->battery_remaining;
  if (world.map->frontiers) summary.frontiers = *world.map->frontiers;
  summary.targets = world.targets->targets;
  recognizes = world.objects != nullptr;
  if (recognizes) summary.objects = world.objects->objects;
  grid = world.map->grid;
  const common::MissionStatus& mission = world.mission->status;
  if (mission.state == MissionState::kReady || mission_over) return;

  if (!mission_begin) mission_begin = world.stamp;
  summary.mission_time = world.stamp - *mission_begin;
  mission_over = common::isOver(mission.state);
  if (!summary.phases.empty()) summary.phases.back().end = world.stamp;
  if (mission_over || mission.phase.empty()) return;
  const std::string by = common::toString(mission.flown_by);
  if (summary.phases.empty() || summary.phases.back().name != mission.phase || summary.phases.back().flown_by != by)
    summary.phases.push_back({mission.phase, world.stamp, world.stamp, by,
                              mission.flown_by == common::FlownBy::kMission ? "" : mission.reason});
}

/// A mission may load another map than it began with; poses and figures are those in the last one.
void RunFolder::Impl::beginGiven(const std::shared_ptr<const common::GivenMap>& map) {
  given = map;
  summary.localization.emplace();
  summary.localization->map = map->name;
  auto writer = TumWriter::create(path / "trajectory_given.tum");
  if (!writer) return keep(tl::unexpected(writer.error()));
  given_trajectory_file = std::move(*writer);
}

void RunFolder::Impl::localize(const common::World& world) {
  if (!world.map->localization || !world.map->given) return;
  if (given != world.map->given) beginGiven(world.map->given);
  const common::Localization& now = *world.map->localization;
  LocalizationSummary& localization = *summary.localization;
  localization.last = now;
  if (world.vehicle->flight_state != common::FlightState::kFlying) {
    last_flown.reset();
    return;
  }
  const double elapsed_s = last_flown ? (world.stamp - *last_flown).seconds() : 0.0;
  last_flown = world.stamp;
  localization.flown_s += elapsed_s;
  if (!now.localized()) return;
  localization.localized_s += elapsed_s;
  if (!localization.found_after_s) {
    localization.found_after_s = world.stamp.seconds();
    localization.found_after_m = world.vehicle->distance_flown_m;
  }
  const common::Pose3 T_given_odom = common::lifted(now.T_given_odom, 0.0);
  if (!failure && given_trajectory_file)
    keep(given_trajectory_file->write({world.vehicle->state.stamp, T_given_odom * world.vehicle->state.T_odom_body}));
}

/// A frame is written once; a frame that did not fit has no pose of its own.
void RunFolder::Impl::followCamera(const common::World& world) {
  if (!world.map3d || !world.map3d->frame || !world.map3d->tracked || failure) return;
  const Time stamp = world.map3d->frame->stamps.measured;
  if (camera_trajectory_file && stamp <= camera_stamp) return;
  if (!camera_trajectory_file) {
    auto writer = TumWriter::create(path / "trajectory_camera.tum");
    if (!writer) return keep(tl::unexpected(writer.error()));
    camera_trajectory_file = std::move(*writer);
  }
  camera_stamp = stamp;
  keep(camera_trajectory_file->write({stamp, world.map3d->T_map_camera * T_camera_optical()}));
}

RunFolder::RunFolder(fs::path path, RunInfo info, std::string config_yaml)
    : impl_(std::make_unique<Impl>(std::move(path), std::move(info), std::move(config_yaml))) {
  impl_->write("config.yaml", fmt::format("# The settings of a flight with Swiftlet {}.\n{}",
                                          toString(impl_->summary.info.version), impl_->config_yaml));
  for (const RunText& sheet : impl_->summary.info.sheets) impl_->write(sheet.file.c_str(), sheet.text);
  if (!impl_->summary.info.nature_yaml.empty()) impl_->write("nature.yaml", impl_->summary.info.nature_yaml);
  if (!impl_->summary.info.vehicle_memory_yaml.empty())
    impl_->write(kMemoryReadFile, impl_->summary.info.vehicle_memory_yaml);
  impl_->writeSummary();
  if (impl_->failure) throw InputError({}, "", Message("run.not-written", "{}", *impl_->failure));
}

RunFolder::~RunFolder() = default;
RunFolder::RunFolder(RunFolder&&) noexcept = default;
RunFolder& RunFolder::operator=(RunFolder&&) noexcept = default;

void RunFolder::state(const common::VehicleState& state) {
  if (impl_->failure || !impl_->trajectory_due.due(state.stamp)) return;
  impl_->keep(impl_->trajectory_file.write({state.stamp, state.T_map_body()}));
}

void RunFolder::event(const common::Event& event) {
  impl_->events.push_back(event);
  if (!impl_->failure) impl_->keep(impl_->events_file.write(event));
}

void RunFolder::world(const common::World& world) {
  impl_->track(world);
  impl_->localize(world);
  impl_->followCamera(world);
  impl_->last_snapshot = world.stamp;
  if (impl_->sample_due.due(world.stamp)) impl_->summary.samples.push_back(sampleOf(world));
  if (impl_->failure || !impl_->map_due.due(world.stamp)) return;
  impl_->keep(writeMap(impl_->path, "map", *impl_->grid));
  impl_->writeSummary();
}

void RunFolder::saveMap(const std::string& name, const common::OccupancyGrid& grid) {
  if (!impl_->failure) impl_->keep(writeMap(impl_->path, "map-" + name, grid));
}

void RunFolder::savePhoto(const std::string& name, const common::RgbdFrame& frame, const common::Pose3& T_map_camera) {
  constexpr int kQuality = 90;  // Of JPEG: photographs are kept, the stream is not.
  const std::string file = fmt::format("photo-{:02}-{}", ++impl_->photos, name);
  const std::vector<std::uint8_t> jpeg =
      common::JpegEncoder(common::ImageContent::kPhoto).encode(frame.color, kQuality);
  const common::RollPitchYaw angles = common::rollPitchYaw(T_map_camera.rotation);
  const Eigen::Vector3d& at = T_map_camera.position_m;
  impl_->pictures.photos.push_back({fmt::format("{}, from ({:.2f}, {:.2f}, {:.2f}) at {:.0f} s", name, at.x(), at.y(),
                                                at.z(), frame.stamps.measured.seconds()),
                                    common::base64(jpeg)});
  if (impl_->failure) return;
  impl_->write((file + ".jpg").c_str(), {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
  impl_->write((file + ".json").c_str(),
               fmt::format("{{\"stamp_s\": {:.3f}, \"camera_map_m\": [{:.3f}, {:.3f}, {:.3f}], \"roll_rad\": {:.4f}, "
                           "\"pitch_rad\": {:.4f}, \"yaw_rad\": {:.4f}}}\n",
                           frame.stamps.measured.seconds(), at.x(), at.y(), at.z(), angles.roll_rad, angles.pitch_rad,
                           angles.yaw_rad));
}

void RunFolder::saveObjectPicture(const common::RecognizedObject& object, const std::vector<std::uint8_t>& jpeg) {
  const Eigen::Vector3d& at = object.T_map_object.position_m;
  impl_->pictures.objects.push_back(
      {fmt::format("{} at ({:.2f}, {:.2f}, {:.2f})", labelOf(object), at.x(), at.y(), at.z()), common::base64(jpeg)});
  std::string what = object.what;
  std::replace_if(
      what.begin(), what.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  if (!impl_->failure)
    impl_->write(fmt::format("object-{:02}-{}.jpg", object.id, what).c_str(),
                 {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
}

void RunFolder::savePlaces(const common::TopologicalMap& map) {
  if (!impl_->failure) impl_->write("topological_map.yaml", toYaml(map), Durability::kPower);
}

void RunFolder::show(ReportPictures pictures) {
  pictures.photos = std::move(impl_->pictures.photos);
  pictures.objects = std::move(impl_->pictures.objects);
  impl_->pictures = std::move(pictures);
  if (!impl_->failure && !impl_->pictures.map_png.empty()) impl_->write("map.png", impl_->pictures.map_png);
}

void RunFolder::wroteMap3d(const Map3dWritten& result) {
  impl_->keep(result.written);
  if (result.octree_stamp) impl_->octree_stamp = result.octree_stamp;
}

/// Appends the bytes of the lines to one text, so that the file is written at once.
void RunFolder::Impl::writeTruth(const common::Trajectory& truth_map) {
  if (truth_map.empty()) return;
  std::string lines;
  for (const common::StampedPose& pose : truth_map) lines += toTumLine(pose);
  write("ground_truth.tum", lines);
}

void RunFolder::finish(const FlightEnd& end) {
  Impl& run = *impl_;
  run.summary.outcome = end.outcome;
  run.summary.reason = end.reason;
  run.summary.coverage = end.coverage;
  run.summary.figures = end.figures;
  run.summary.wall_time_s = end.wall_time_s;
  run.summary.machine = end.machine;
  if (end.wall_time_s && *end.wall_time_s > 0)
    run.summary.realtime_factor = run.last_snapshot.seconds() / *end.wall_time_s;
  if (run.grid) run.keep(writeMap(run.path, "map", *run.grid, Durability::kPower));
  if (!run.pictures.map_png.empty()) run.write("map.png", run.pictures.map_png, Durability::kPower);
  run.writeTruth(end.ground_truth_map);
  if (!end.vehicle_memory_yaml.empty()) run.write(kMemoryLearnedFile, end.vehicle_memory_yaml);
  run.writeSummary(Durability::kPower);
}

const fs::path& RunFolder::path() const { return impl_->path; }
const FlightSummary& RunFolder::summary() const { return impl_->summary; }
const std::optional<std::string>& RunFolder::failure() const { return impl_->failure; }

}  // namespace swiftlet::interfaces
