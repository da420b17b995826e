// swiftlet convert: between the formats of 3D maps, and from a 3D map to a floor plan.
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "apps/command.hpp"
#include "apps/output_file.hpp"
#include "apps/recorded_log.hpp"
#include "apps/required.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/point_cloud.hpp"
#include "interfaces/files/unpacked_stream.hpp"
#include "mapping3d/voxels/floor_plan.hpp"
#include "mapping3d/voxels/point_voxels.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

/// A voxel's side where a cloud becomes an octree, the one of the maps that flights leave.
constexpr double kUsualResolution_m = 0.05;
/// By how much a point may be moved where its coordinates are rounded to single precision.
constexpr double kMostRounding_m = 0.001;

struct ConvertOptions {
  std::string from;
  std::string to;
  std::optional<double> low_m;
  std::optional<double> high_m;
  std::optional<double> resolution_m;
};

enum class Kind { kOctree, kCloud, kFloorPlan };

/// Throws InputError for a name with another ending.
Kind kindOf(const fs::path& file, bool may_be_plan) {
  if (file.extension() == ".bt" || file.extension() == ".ot") return Kind::kOctree;
  if (interfaces::cloudFormatOf(file)) return Kind::kCloud;
  if (may_be_plan && file.extension() == ".yaml") return Kind::kFloorPlan;
  throw common::InputError(common::Problem{
      {file.string()},
      "",
      fmt::format("`{}` is not a kind of 3D map", file.extension().string()),
      may_be_plan ? "name it .bt, .ot, .ply, .pcd, or .yaml for a floor plan" : "it must be .bt, .ot, .ply or .pcd"});
}

[[noreturn]] void refuseFile(const ConvertOptions& options, const std::string& message, const std::string& hint) {
  throw common::InputError(common::Problem{{options.from}, "", message, hint});
}

/// Says how many points are left out. Throws InputError if none is left.
void sayLeftOut(const ConvertOptions& options, std::size_t left_out, std::size_t all, const std::string& where,
                const std::string& hint) {
  if (left_out == 0) return;
  const std::string points = plural(all, "point", "points");
  if (left_out == all) refuseFile(options, fmt::format("all of its {} are {}", points, where), hint);
  show(fmt::format("note: {} of {} left out: {}\n", left_out, points, where));
}

std::vector<common::SurfacePoint> readPoints(const ConvertOptions& options) {
  interfaces::StoredCloud cloud = interfaces::readCloud(options.from);
  sayLeftOut(options, cloud.not_finite, cloud.points.size() + cloud.not_finite, "without a finite position", "");
  if (cloud.rounding_m > kMostRounding_m)
    refuseFile(
        options,
        fmt::format("its coordinates are so great that they would be rounded by up to {:.3g} m", cloud.rounding_m),
        "subtract an offset from them first: they are kept in single precision");
  return std::move(cloud.points);
}

common::VoxelMap readVoxels(const ConvertOptions& options, Kind from) {
  if (from == Kind::kOctree) return interfaces::readOctree(options.from);
  const std::vector<common::SurfacePoint> points = readPoints(options);
  const double resolution_m = options.resolution_m.value_or(kUsualResolution_m);
  mapping3d::PointVoxels voxels = mapping3d::voxelsAround(points, resolution_m, interfaces::kMostOctreeBlocks);
  if (voxels.full)
    refuseFile(options,
               fmt::format("its points fill more than {} blocks of 8 x 8 x 8 voxels of {:g} m",
                           interfaces::kMostOctreeBlocks, resolution_m),
               "give a greater --resolution");
  sayLeftOut(options, voxels.left_out, points.size(),
             fmt::format("farther than {:.0f} m from the origin, where an octree of this resolution ends",
                         mapping3d::octreeReach_m(resolution_m)),
             "are they in metres? Move them to the origin, or give a greater --resolution");
  return std::move(voxels.map);
}

void writePlan(const common::VoxelMap& map, const ConvertOptions& options, Kind from) {
  const fs::path yaml = options.to;
  const common::OccupancyGrid plan = mapping3d::floorPlan(map, {*options.low_m, *options.high_m});
  const common::CellRect known = knownExtent(plan);
  if (known.empty())
    refuseFile(options, fmt::format("nothing is known from {} to {} m", *options.low_m, *options.high_m), "");
  if (!interfaces::isReadable(plan))
    refuseFile(
        options,
        fmt::format("the plan would be {} by {} cells of {:g} m", known.width(), known.height(), plan.resolution_m()),
        from == Kind::kCloud ? "remove points far away, or give a greater --resolution" : "");
  if (from == Kind::kCloud)
    show("note: a cloud does not tell where room is free: nothing can be planned in a plan of occupied cells alone\n");
  required(interfaces::writeMap(yaml.has_parent_path() ? yaml.parent_path() : ".", yaml.stem().string(), plan));
}

/// Before the work.
void checkOptions(const ConvertOptions& options, Kind from, Kind to) {
  const auto refuse = [](const std::string& option, const std::string& message, const std::string& hint) {
    throw common::InputError(common::Problem{{}, option, message, hint});
  };
  if (options.resolution_m && (from != Kind::kCloud || to == Kind::kCloud))
    refuse("--resolution", "only a cloud that becomes voxels has a resolution to choose", "");
  if (to != Kind::kFloorPlan && (options.low_m || options.high_m))
    refuse("--low", "heights are those of a floor plan", "name it .yaml");
  if (to == Kind::kFloorPlan && (!options.low_m || !options.high_m))
    refuse("convert", "a floor plan needs the heights that it shows", "for instance --low 0.8 --high 1.2");
  if (to == Kind::kFloorPlan && *options.low_m > *options.high_m)
    refuse("--low", fmt::format("{} is above --high {}", *options.low_m, *options.high_m), "");
}

int convert(const ConvertOptions& options) {
  const Kind from = kindOf(interfaces::unpackedName(options.from), false), to = kindOf(options.to, true);
  checkOptions(options, from, to);
  requireWritable(options.to, "convert");
  if (to == Kind::kFloorPlan)
    writePlan(readVoxels(options, from), options, from);
  else if (to == Kind::kOctree)
    required(interfaces::writeOctree(options.to, readVoxels(options, from)));
  else
    required(interfaces::writeCloud(
        options.to,
        from == Kind::kCloud ? readPoints(options) : mapping3d::occupiedCenters(interfaces::readOctree(options.from))));
  show(fmt::format("written {}\n", options.to));
  return kDone;
}

}  // namespace

void addConvert(Command& program) {
  auto options = std::make_shared<ConvertOptions>();
  Command command = program.command("convert", "Convert a 3D map to another format, or to a floor plan.");
  command.argument(
      "from", options->from,
      "Octree of OctoMap (.bt or .ot) or a cloud of points (.ply or .pcd), plain or packed by gzip, bzip2 or xz.");
  command.argument(
      "to", options->to,
      ".bt or .ot: an octree; .ply or .pcd: a cloud, with a point in each occupied voxel of an octree; .yaml: a "
      "floor plan as map_server reads it, with a .pgm beside it.");
  command.option("--low", options->low_m, {-1e4, 1e4}, "Lower end of the heights of a floor plan, in metres.");
  command.option("--high", options->high_m, {-1e4, 1e4}, "Upper end.");
  command.option("--resolution", options->resolution_m, {0.001, 10.0},
                 "Side of the voxels that a cloud becomes, in metres. 0.05 when not given.");
  command.footer("Example: swiftlet convert runs/first/map.bt plan.yaml --low 0.8 --high 1.2");
  command.runs([options] { return convert(*options); });
}

}  // namespace swiftlet::apps
