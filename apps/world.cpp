// swiftlet world: a world to fly in, from a map of a building.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "apps/cloud_unit.hpp"
#include "apps/command.hpp"
#include "apps/listed_numbers.hpp"
#include "apps/map_kind.hpp"
#include "apps/output_file.hpp"
#include "apps/show.hpp"
#include "apps/start_option.hpp"
#include "apps/world_file.hpp"
#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "interfaces/clouds/point_cloud.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/movingai.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/unpacked_stream.hpp"
#include "mapping3d/voxels/floor_growth.hpp"
#include "mapping3d/voxels/free_space.hpp"
#include "mapping3d/voxels/free_surface.hpp"
#include "mapping3d/voxels/point_voxels.hpp"
#include "mapping3d/voxels/standing_place.hpp"
#include "simulation/variation.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;
using mapping3d::FreeSpace;
using mapping3d::StandingPlace;

/// Of the walls of a floor plan: a usual room's.
constexpr double kUsualHeight_m = 2.5;
/// Of the cells of a grid without metres: its narrowest passage, one cell, is then wide enough for the hull.
constexpr double kUsualCell_m = 1.0;
/// Rectangles of a world: a gigabyte of mesh.
constexpr std::size_t kMostFaces = 10'000'000;

struct WorldOptions {
  std::string from;
  std::string out;
  std::string start;
  std::optional<double> height_m;
  std::optional<double> floor_m;
  std::optional<double> resolution_m;
  std::optional<double> scale;
};

void tell(const std::string& text) { show(text + "\n"); }

[[noreturn]] void refuseMap(const WorldOptions& options, const Message& message, const std::string& hint = "") {
  throw InputError({options.from}, "", message, hint);
}

void refuseOption(const std::string& option, const Message& message) { throw InputError({}, option, message); }

void checkOptions(const WorldOptions& options, MapKind kind) {
  if (options.resolution_m && kind != MapKind::kCloud && kind != MapKind::kGrid)
    refuseOption("--resolution",
                 Message("world.has-resolution", "this map has its own; only that of a cloud or a grid is chosen"));
  if (options.scale && kind != MapKind::kCloud)
    refuseOption("--scale", Message("world.in-metres", "this map is in metres; only a cloud may be in another unit"));
  if (options.floor_m && (kind == MapKind::kFloorPlan || kind == MapKind::kGrid))
    refuseOption("--floor", Message("world.floor-of-plan", "the floor of a floor plan is at 0"));
}

/// Nothing that is there is replaced: a world may have been edited since it was made.
void requireNew(const fs::path& out) {
  const std::string ending = common::endingOf(out);
  if (ending != ".sdf" && ending != ".world")
    throw InputError({out.string()}, "--out", Message("world.no-sdf", "does not end with .sdf"), "name it so");
  for (const fs::path& file : {out, meshOf(out)}) {
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(file, ignored)))
      throw InputError({file.string()}, "--out", Message("world.exists", "is there already"),
                       "give another name, or remove it first");
    requireWritable(file, "--out");
  }
}

simulation::StartConfig wantedStart(const WorldOptions& options) {
  return options.start.empty() ? simulation::StartConfig{false} : parseStart(options.start);
}

/// The height above the start from which its floor is searched, as the simulator does; nullopt where none is given.
std::optional<double> wantedHeight_m(const WorldOptions& options) {
  constexpr double kAbove_m = 0.5;
  if (listedNumbers(options.start).size() != 4) return std::nullopt;
  return wantedStart(options).z_m + kAbove_m;
}

mapping3d::StandingRoom roomOf(const simulation::Scenario& scenario) {
  constexpr double kGap_m = 0.1;  // Gusts move a vehicle by up to 9 cm before it flies.
  const common::VehicleConfig& vehicle = scenario.vehicle;
  return {vehicle.hullRadius_m() + kGap_m,
          std::min(scenario.variation.flight_height_m, vehicle.max_height_m) + 0.5 * vehicle.hull_height_m + kGap_m,
          scenario.quadrotor.gear_radius_m};
}

/// A map as a space.
struct Building {
  FreeSpace space;
  common::Pose2 T_world_map;
  MapKind kind = MapKind::kFloorPlan;
};

class WorldMaker {
 public:
  explicit WorldMaker(const WorldOptions& options)
      : options_(options), start_(wantedStart(options)), from_height_m_(wantedHeight_m(options)) {
    scenario_.start = start_;
  }

  void make() {
    building_.kind = mapKindOf(options_.from);
    checkOptions(options_, building_.kind);
    requireNew(out());
    if (building_.kind == MapKind::kFloorPlan)
      readPlan();
    else if (building_.kind == MapKind::kGrid)
      readGrid();
    else if (building_.kind == MapKind::kOctree)
      readTree();
    else
      readPoints();
    MadeWorld world{mapping3d::surfaceOf(building_.space, kMostFaces), building_.T_world_map, start_};
    const std::size_t faces = world.surface_map_m.size();
    if (faces > kMostFaces)
      refuseMap(options_, Message("world.too-many-faces", "its free space has more than {} faces", kMostFaces),
                "its resolution is finer than what it shows: make it coarser");
    checkStart(world);
    const std::size_t bytes = writeWorld(world, out());
    tell(fmt::format("written {} and {}: {} triangles, {:.1f} MB", out().string(), meshOf(out()).filename().string(),
                     2 * faces, static_cast<double>(bytes) * 1e-6));
  }

 private:
  fs::path out() const {
    if (!options_.out.empty()) return options_.out;
    return interfaces::unpackedName(options_.from).filename().replace_extension(".sdf");
  }

  void readPlan() {
    const interfaces::StoredMap map = interfaces::readMap(options_.from);
    showNotes(map.notes);
    building_.T_world_map = map.T_map_grid;
    raiseWalls(map.grid);
  }

  void readGrid() {
    const double cell_m = options_.resolution_m.value_or(kUsualCell_m);
    if (!options_.resolution_m) tell(fmt::format("assumed: cells of {:g} m (--resolution)", cell_m));
    raiseWalls(interfaces::readOctileMap(options_.from, cell_m).grid);
  }

  void raiseWalls(const common::OccupancyGrid& plan) {
    if (knownExtent(plan).empty()) refuseMap(options_, Message("world.nothing-known", "nothing in it is known"));
    const double height_m = options_.height_m.value_or(kUsualHeight_m);
    building_.space = mapping3d::freeSpaceOf(plan, height_m);
    const Eigen::Vector3d& cell_m = building_.space.voxel_m;
    tell(fmt::format("floor plan: {:.1f} m2 free, in cells of {:g} m; what is unknown is wall",
                     freeCells() * cell_m.x() * cell_m.y(), cell_m.x()));
    tell(fmt::format("assumed: floor at 0.00 m, walls and ceiling of {:.2f} m{}", height_m,
                     options_.height_m ? "" : " (--height)"));
    findStart();
  }

  void readTree() {
    const interfaces::StoredOctree octree = interfaces::readOctree(options_.from);
    for (const std::string& note : octree.notes) tell("note: " + note);
    requireSize(mapping3d::extentOf(octree.map), octree.map.resolution_m());
    if (mapping3d::occupiedCount(octree.map) == 0)
      refuseMap(options_, Message("world.nothing-occupied", "no voxel in it is occupied"));
    building_.space = mapping3d::freeSpaceOf(octree.map);
    if (building_.space.free.count() == 0) {
      tell("note: the octree knows no free voxels, and is taken as a cloud of points");
      return closeAround(mapping3d::occupiedCenters(octree.map), octree.map.resolution_m());
    }
    const double voxel_m = octree.map.resolution_m();
    tell(fmt::format("octree: {:.1f} m3 free, in voxels of {:g} m; what is unknown is matter",
                     freeCells() * voxel_m * voxel_m * voxel_m, voxel_m));
    setFloor();
    findStart();
    setCeiling();
    keepFromStart();
    tellHeights();
  }

  void readPoints() {
    interfaces::CloudPlacement placement;
    placement.scale = options_.scale.value_or(1.0);
    const interfaces::StoredCloud cloud = interfaces::readCloud(options_.from, placement);
    for (const std::string& note : mapNotes(options_.from, cloud, options_.scale.has_value())) tell("note: " + note);
    if (cloud.points.empty()) refuseMap(options_, Message("world.no-points", "it has no points"));
    const double hull_m = 2.0 * scenario_.vehicle.hullRadius_m();
    const double spacing_m = mapping3d::spacingOf_m(cloud.points, hull_m);
    if (spacing_m >= hull_m)
      refuseMap(options_,
                Message("world.sparse", "its points are {:.2g} m apart and more: the hull fits between them", hull_m),
                kUnitHint);
    if (options_.resolution_m && *options_.resolution_m < spacing_m)
      throw InputError(
          {}, "--resolution",
          Message("world.too-fine", "voxels of {:g} m are smaller than the distance of the points, {:.3f} m",
                  *options_.resolution_m, spacing_m),
          "its surfaces would have holes");
    const double voxel_m = options_.resolution_m.value_or(mapping3d::voxelSideOf_m(spacing_m));
    tell(fmt::format("cloud: {} points, {:.3f} m apart, in voxels of {:g} m{}", cloud.points.size(), spacing_m, voxel_m,
                     options_.resolution_m ? "" : " (--resolution)"));
    closeAround(cloud.points, voxel_m);
  }

  /// The least closing of holes from which the free space at the start does not reach around the surfaces.
  void closeAround(const std::vector<common::SurfacePoint>& points, double voxel_m) {
    // A hole that the hull fits through is a door.
    const double hull_m = 2.0 * scenario_.vehicle.hullRadius_m();
    const int most = std::max(1, static_cast<int>(std::ceil(0.5 * hull_m / voxel_m)) - 1), margin = most + 2;
    requireSize(mapping3d::extentOf(points, voxel_m, margin), voxel_m);
    const FreeSpace whole = mapping3d::spaceAround(points, voxel_m, margin);
    for (int radius = 1; radius <= most; ++radius) {
      building_.space = whole;
      mapping3d::closeHoles(building_.space, radius);
      setFloor();
      findStart();
      setCeiling();
      const bool open = keepFromStart();
      if (open && radius < most) continue;
      tellHeights();
      tell(fmt::format("holes of up to {:.2f} m are closed", 2 * radius * voxel_m));
      if (open) tell("note: the free space at the start reaches the edge of the cloud, where walls are assumed");
      return;
    }
  }

  void requireSize(const mapping3d::SpaceExtent& extent, double voxel_m) const {
    if (extent.voxels() > mapping3d::kMostSpaceVoxels)
      refuseMap(
          options_,
          Message("world.too-many-voxels", "it reaches over {:.0f} x {:.0f} x {:.0f} m, too far for voxels of {:g} m",
                  (extent.end.x - extent.begin.x) * voxel_m, (extent.end.y - extent.begin.y) * voxel_m,
                  (extent.end.z - extent.begin.z) * voxel_m, voxel_m),
          building_.kind == MapKind::kCloud ? fmt::format("remove points far away; {}", kUnitHint)
                                            : "remove what is far away");
  }

  double freeCells() const { return static_cast<double>(building_.space.free.count()); }

  /// At the height that is given, or as it was measured around the start.
  void setFloor() {
    if (options_.floor_m)
      mapping3d::raiseFloor(building_.space, *options_.floor_m);
    else  // Without a floor the start is refused, with the nearest place that has one.
      (void)mapping3d::growFloor(building_.space, start_map_m(), roomOf(scenario_), scenario_.vehicle.hull_height_m,
                                 from_height_m_);
  }

  /// A height that is given is that of a ceiling above the floor at the start.
  void setCeiling() {
    if (!options_.height_m) return;
    mapping3d::lowerCeiling(building_.space, place_.floor_m.z() + *options_.height_m);
    findStart();
  }

  Eigen::Vector2d start_map_m() const {
    return building_.T_world_map.inverse() * Eigen::Vector2d(start_.x_m, start_.y_m);
  }
  std::optional<StandingPlace> placeOfStart() const {
    return mapping3d::floorAt(building_.space, start_map_m(), roomOf(scenario_), from_height_m_);
  }

  /// Puts the start on its floor.
  void findStart() {
    const auto place = placeOfStart();
    if (!place)
      refuseStart(
          Message("world.no-place", "at ({:.2f}, {:.2f}) no floor has free space above it", start_.x_m, start_.y_m));
    place_ = *place;
    start_.z_m = place_.floor_m.z();
  }

  bool keepFromStart() {
    whole_ = building_.space;
    const Eigen::Vector3d voxel =
        (place_.floor_m - building_.space.corner_m).cwiseQuotient(building_.space.voxel_m) + Eigen::Vector3d(0, 0, 0.5);
    return mapping3d::keepConnected(building_.space,
                                    {static_cast<int>(std::floor(voxel.x())), static_cast<int>(std::floor(voxel.y())),
                                     static_cast<int>(std::floor(voxel.z()))});
  }

  void tellHeights() const {
    const auto found = [](bool measured) { return measured ? "found" : "assumed, nothing was measured there"; };
    tell(fmt::format("at the start: floor at {:.2f} m ({}), ceiling at {:.2f} m ({})", place_.floor_m.z(),
                     found(place_.floor_measured), place_.ceiling_m, found(place_.ceiling_measured)));
    tell(fmt::format("of the floor {:.0f} % was measured, the rest is assumed to be level with it",
                     100.0 * mapping3d::measuredFloorShare(building_.space)));
  }

  [[noreturn]] void refuseStart(const Message& message) const {
    const FreeSpace& space = whole_ ? *whole_ : building_.space;
    const auto nearest = mapping3d::nearestStandingPlace(space, start_map_m(), roomOf(scenario_));
    std::string hint = "the hull fits nowhere in it";
    if (nearest) {
      const Eigen::Vector2d place_m = building_.T_world_map * Eigen::Vector2d(nearest->floor_m.head<2>());
      hint = fmt::format("the nearest place with room for the hull is --start \"{:.2f};{:.2f};{:g}\"", place_m.x(),
                         place_m.y(), start_.yaw_deg);
    } else if (building_.kind != MapKind::kFloorPlan && !options_.floor_m) {
      hint += "; where no level floor was measured, give --floor, its height";
    }
    throw InputError({options_.from}, "--start", message, hint);
  }

  /// As a flight does it.
  void checkStart(const MadeWorld& world) {
    simulation::Scenario scenario = scenario_;
    scenario.start = start_;
    try {
      (void)simulation::realize(modelOf(world, out()), scenario);
    } catch (const InputError& error) {
      refuseStart(error.problems().front().message);
    }
    tell(fmt::format("start: --start \"{:.2f};{:.2f};{:.2f};{:g}\"", start_.x_m, start_.y_m, start_.z_m,
                     start_.yaw_deg));
  }

  const WorldOptions& options_;
  simulation::Scenario scenario_;
  simulation::StartConfig start_;
  std::optional<double> from_height_m_;  ///< See wantedHeight_m.
  Building building_;
  std::optional<FreeSpace> whole_;  ///< With what is not connected with the start, where another may be.
  StandingPlace place_;
};

}  // namespace

void addWorld(Command& program) {
  auto options = std::make_shared<WorldOptions>();
  Command command = program.command("world", "Make a world to fly in from a floor plan, an octree or a cloud.");
  command.argument(
      "from", options->from,
      "Floor plan as map_server reads it (.yaml), octree of OctoMap (.bt, .ot), cloud of points (.ply, .pcd) "
      "or grid of the Moving AI benchmarks (.map), the last three also packed by gzip, bzip2 or xz.");
  command.option(
      "--out", options->out,
      "The world, .sdf; its mesh .stl is beside it. Named after the map when not given, in the working folder.");
  command.option(
      "--start", options->start,
      "\"x;y;yaw\" or \"x;y;z;yaw\" in the map, in metres and degrees: where the vehicle stands. \"0;0;0\" when "
      "not given.");
  command.option("--height", options->height_m, {0.5, 100.0},
                 "Of the walls of a floor plan, 2.5 when not given; else a ceiling above the floor, in metres.");
  command.option("--floor", options->floor_m, {-1e4, 1e4},
                 "Height of a floor in an octree or a cloud; nothing below it counts. When not given, it is found.");
  command.option("--resolution", options->resolution_m, {0.01, 2.0},
                 "Side of the voxels that a cloud becomes, in metres, chosen from the distance of its points when not "
                 "given; of the cells of a grid, 1 when not given.");
  command.option("--scale", options->scale, {1e-6, 1e6},
                 "Metres in one unit of a cloud's coordinates: 0.001 if they are in millimetres. 1 when not given.");
  command.footer("Example: swiftlet world plan.yaml --out hall.sdf --start \"1.5;2;90\"");
  command.runs([options] {
    WorldMaker(*options).make();
    return kDone;
  });
}

}  // namespace swiftlet::apps
