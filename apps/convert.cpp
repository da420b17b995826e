// swiftlet convert: between the formats of 3D maps, and from a 3D map to a floor plan.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "apps/cloud_unit.hpp"
#include "apps/command.hpp"
#include "apps/listed_numbers.hpp"
#include "apps/output_file.hpp"
#include "apps/recorded_log.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "interfaces/clouds/point_cloud.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/required.hpp"
#include "interfaces/files/unpacked_stream.hpp"
#include "mapping3d/voxels/floor_plan.hpp"
#include "mapping3d/voxels/point_voxels.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

/// A voxel's side where a cloud becomes an octree: that of the maps that flights leave.
constexpr double kUsualResolution_m = 0.05;
/// By how much a point may be moved where its coordinates are rounded to single precision.
constexpr double kMostRounding_m = 0.001;
/// Points that an octree may become. A few bytes of a file can be a cube of billions of voxels.
constexpr std::size_t kMostPoints = 50'000'000;

struct ConvertOptions {
  std::string from;
  std::string to;
  std::optional<double> scale;
  std::string origin;
  std::optional<double> low_m;
  std::optional<double> high_m;
  std::optional<double> resolution_m;
};

enum class Kind { kOctree, kCloud, kFloorPlan };

/// What to do with files of other kinds.
std::string hintFor(const std::string& ending) {
  constexpr const char* kRead = "it must be .bt, .ot, .ply or .pcd, plain or packed by gzip, bzip2 or xz";
  for (const char* table : {".xyz", ".txt", ".asc", ".csv", ".pts", ".ptx", ".las", ".laz", ".e57", ".obj", ".stl"})
    if (ending == table) return fmt::format("{}: save it as .ply, for instance with CloudCompare", kRead);
  return kRead;
}

/// By the ending, in any case; a plan is written as .yaml alone. Throws InputError for a name with another ending.
Kind kindOf(const fs::path& file, bool may_be_plan) {
  const std::string ending = common::endingOf(file);
  if (ending == ".bt" || ending == ".ot") return Kind::kOctree;
  if (interfaces::cloudFormatOf(file)) return Kind::kCloud;
  if (may_be_plan && file.extension() == ".yaml") return Kind::kFloorPlan;
  throw common::InputError(
      {file.string()}, "",
      common::Message("convert.other-kind", "`{}` is not a kind of 3D map", file.extension().string()),
      may_be_plan ? "name it .bt, .ot, .ply, .pcd, or .yaml for a floor plan" : hintFor(ending));
}

[[noreturn]] void refuseFile(const ConvertOptions& options, const common::Message& message, const std::string& hint) {
  throw common::InputError({options.from}, "", message, hint);
}

void tellNotes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) show(fmt::format("note: {}\n", note));
}

/// Says how many points are left out, with the hint if a good share is. Throws InputError if none is left.
void sayLeftOut(const ConvertOptions& options, std::size_t left_out, std::size_t all, const std::string& where,
                const std::string& hint) {
  if (left_out == 0) return;
  const std::string points = plural(all, "point", "points");
  if (left_out == all)
    refuseFile(options, common::Message("convert.no-points-left", "all of its {} are {}", points, where), hint);
  const bool many = left_out > all / 10 && !hint.empty();
  tellNotes({fmt::format("{} of {} left out: {}{}", left_out, points, where, many ? ": " + hint : "")});
}

interfaces::CloudPlacement placementOf(const ConvertOptions& options) {
  interfaces::CloudPlacement placement;
  placement.scale = options.scale.value_or(1.0);
  if (options.origin.empty()) return placement;
  const std::vector<double> origin = listedNumbers(options.origin);
  if (origin.size() != 3)
    throw common::InputError({}, "--origin", common::Message("convert.no-origin", "`{}` is not x;y;z", options.origin),
                             "for instance 512300;5412300;0");
  placement.origin_file = {origin[0], origin[1], origin[2]};
  return placement;
}

/// An origin near most of the points, in whole hundreds. The height stays unless it is great too: floors are known by
/// it.
std::string originNear(const std::vector<common::SurfacePoint>& points, const interfaces::CloudPlacement& placement) {
  const auto middle = [&](int axis) {
    std::vector<float> values;
    for (const common::SurfacePoint& point : points) values.push_back(point.position_m[axis]);
    const auto median = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), median, values.end());
    return 100.0 * std::floor((*median / placement.scale + placement.origin_file[axis]) / 100.0);
  };
  const double z = middle(2);
  return fmt::format("--origin '{:.0f};{:.0f};{:.0f}'", middle(0), middle(1), std::abs(z) < 1e4 ? 0.0 : z);
}

void sayUnless(bool known, const std::string& note) {
  if (!known && !note.empty()) tellNotes({note});
}

interfaces::StoredCloud readPoints(const ConvertOptions& options) {
  const interfaces::CloudPlacement placement = placementOf(options);
  interfaces::StoredCloud cloud = interfaces::readCloud(options.from, placement);
  tellNotes(cloud.notes);
  sayUnless(options.scale.has_value(), headerUnitNote(options.from, cloud));
  if (cloud.points.empty() && cloud.not_finite == 0) tellNotes({fmt::format("{} holds no points", options.from)});
  sayLeftOut(options, cloud.not_finite, cloud.points.size() + cloud.not_finite, "without a finite position", "");
  if (cloud.rounding_m > kMostRounding_m)
    refuseFile(
        options,
        common::Message("convert.rounded", "its coordinates are so great that they would be rounded by up to {:.3g} m",
                        cloud.rounding_m),
        fmt::format("they are kept in single precision: give {}", originNear(cloud.points, placement)));
  return cloud;
}

/// Octrees are written as OctoMap's OcTree, which has neither.
void sayWithoutColors(const std::vector<common::SurfacePoint>& points) {
  const auto any = [&](const auto& has) { return std::any_of(points.begin(), points.end(), has); };
  if (any([](const common::SurfacePoint& point) { return point.rgb != common::kUnknownColor; }))
    tellNotes({"colours left out: an octree is written without"});
  if (any([](const common::SurfacePoint& point) { return !point.normal.isZero(); }))
    tellNotes({"normals left out: an octree has none"});
}

interfaces::StoredOctree readTree(const ConvertOptions& options) {
  interfaces::StoredOctree octree = interfaces::readOctree(options.from);
  tellNotes(octree.notes);
  if (mapping3d::occupiedCount(octree.map) == 0) tellNotes({fmt::format("{} holds no occupied voxels", options.from)});
  return octree;
}

common::VoxelMap readVoxels(const ConvertOptions& options, Kind from, Kind to) {
  if (from == Kind::kOctree) {
    interfaces::StoredOctree octree = readTree(options);
    if (to == Kind::kOctree && !octree.colors.empty()) tellNotes({"colours left out: an octree is written without"});
    return std::move(octree.map);
  }
  const interfaces::StoredCloud cloud = readPoints(options);
  const std::vector<common::SurfacePoint>& points = cloud.points;
  if (to == Kind::kOctree) sayWithoutColors(points);
  const double resolution_m = options.resolution_m.value_or(kUsualResolution_m);
  mapping3d::PointVoxels voxels = mapping3d::voxelsAround(points, resolution_m, interfaces::kMostOctreeBlocks);
  if (voxels.full)
    refuseFile(
        options,
        common::Message("convert.too-many-blocks", "its points fill more than {} blocks of 8 x 8 x 8 voxels of {:g} m",
                        interfaces::kMostOctreeBlocks, resolution_m),
        fmt::format("give a greater --resolution; {}", kUnitHint));
  sayUnless(options.scale || voxels.left_out > points.size() / 10, extentNote(cloud));
  if (voxels.left_out > 0)
    sayLeftOut(options, voxels.left_out, points.size(),
               fmt::format("farther than {:.0f} m from the origin, where an octree of this resolution ends",
                           mapping3d::octreeReach_m(resolution_m)),
               fmt::format("{}, {} if the origin is far away, or a greater --resolution", kUnitHint,
                           originNear(points, placementOf(options))));
  return std::move(voxels.map);
}

std::vector<common::SurfacePoint> pointsOf(const ConvertOptions& options, Kind from) {
  if (from == Kind::kCloud) {
    interfaces::StoredCloud cloud = readPoints(options);
    sayUnless(options.scale.has_value(), extentNote(cloud));
    return std::move(cloud.points);
  }
  const interfaces::StoredOctree octree = readTree(options);
  const std::size_t occupied = mapping3d::occupiedCount(octree.map);
  if (occupied > kMostPoints)
    refuseFile(options,
               common::Message("convert.too-many-points", "its {} occupied voxels are more than {} points", occupied,
                               kMostPoints),
               "name the result .bt or .ot, which keep a cube of voxels as one");
  return octree.colors.empty() ? mapping3d::occupiedCenters(octree.map) : interfaces::coloredCenters(octree);
}

void writePlan(const common::VoxelMap& map, const ConvertOptions& options, Kind from) {
  const fs::path yaml = options.to;
  const common::OccupancyGrid plan = mapping3d::floorPlan(map, *options.low_m, *options.high_m);
  const common::CellRect known = knownExtent(plan);
  if (known.empty())
    refuseFile(
        options,
        common::Message("convert.nothing-known", "nothing is known from {} to {} m", *options.low_m, *options.high_m),
        "");
  if (!interfaces::isReadable(plan))
    refuseFile(options,
               common::Message("convert.plan-too-large", "the plan would be {} by {} cells of {:g} m", known.width(),
                               known.height(), plan.resolution_m()),
               from == Kind::kCloud
                   ? "remove points far away, give a greater --resolution, or --scale if they are not in metres"
                   : "");
  if (from == Kind::kCloud)
    show("note: a cloud does not tell where room is free: nothing can be planned in a plan of occupied cells alone\n");
  required(interfaces::writeMap(yaml.has_parent_path() ? yaml.parent_path() : ".", yaml.stem().string(), plan));
}

/// Before the work.
void checkOptions(const ConvertOptions& options, Kind from, Kind to) {
  const auto refuse = [](const std::string& option, const common::Message& message, const std::string& hint) {
    throw common::InputError({}, option, message, hint);
  };
  if (options.resolution_m && (from != Kind::kCloud || to == Kind::kCloud))
    refuse("--resolution",
           common::Message("convert.no-resolution", "only a cloud that becomes voxels has a resolution to choose"), "");
  if (from != Kind::kCloud && (options.scale || !options.origin.empty()))
    refuse(options.scale ? "--scale" : "--origin",
           common::Message("convert.coordinates-of-octree", "only the coordinates of a cloud can be changed"), "");
  if (to != Kind::kFloorPlan && (options.low_m || options.high_m))
    refuse(options.low_m ? "--low" : "--high", common::Message("convert.no-plan", "heights are those of a floor plan"),
           "name it .yaml");
  if (to == Kind::kFloorPlan && (!options.low_m || !options.high_m))
    refuse("convert", common::Message("convert.no-heights", "a floor plan needs the heights that it shows"),
           "for instance --low 0.8 --high 1.2");
  if (to == Kind::kFloorPlan && *options.low_m > *options.high_m)
    refuse("--low", common::Message("convert.low-above-high", "{} is above --high {}", *options.low_m, *options.high_m),
           "");
}

int convert(const ConvertOptions& options) {
  const Kind from = kindOf(interfaces::unpackedName(options.from), false), to = kindOf(options.to, true);
  checkOptions(options, from, to);
  requireWritable(options.to, "convert");
  if (to == Kind::kFloorPlan)
    writePlan(readVoxels(options, from, to), options, from);
  else if (to == Kind::kOctree)
    required(interfaces::writeOctree(options.to, readVoxels(options, from, to)));
  else
    required(interfaces::writeCloud(options.to, pointsOf(options, from)));
  show(fmt::format("written {}\n", options.to));
  return kDone;
}

}  // namespace

void addConvert(Command& program) {
  auto options = std::make_shared<ConvertOptions>();
  Command command = program.command("convert", "Convert a 3D map to another format, or to a floor plan.");
  command.argument("from", options->from,
                   "Octree of OctoMap (.bt, or .ot with an OcTree, ColorOcTree, OcTreeStamped or CountingOcTree) or a "
                   "cloud of points (.ply or .pcd), plain or packed by gzip, bzip2 or xz.");
  command.argument(
      "to", options->to,
      ".bt or .ot: an octree; .ply or .pcd: a cloud, with a point in each occupied voxel of an octree; .yaml: a "
      "floor plan as map_server reads it, with a .pgm beside it.");
  command.option("--low", options->low_m, {-1e4, 1e4}, "Lower end of the heights of a floor plan, in metres.");
  command.option("--high", options->high_m, {-1e4, 1e4}, "Upper end.");
  command.option("--resolution", options->resolution_m, {0.001, 10.0},
                 "Side of the voxels that a cloud becomes, in metres. 0.05 when not given.");
  command.option("--scale", options->scale, {1e-6, 1e6},
                 "Metres in one unit of a cloud's coordinates: 0.001 if they are in millimetres. 1 when not given.");
  command.option(
      "--origin", options->origin,
      "\"x;y;z\" of the place in a cloud that becomes the origin, in the cloud's unit. \"0;0;0\" when not given.");
  command.footer("Example: swiftlet convert runs/first/map.bt plan.yaml --low 0.8 --high 1.2");
  command.runs([options] { return convert(*options); });
}

}  // namespace swiftlet::apps
