// swiftlet convert: between the formats of 3D maps, and from a 3D map to a floor plan.
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/core.h>

#include "apps/command.hpp"
#include "apps/required.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/octomap.hpp"
#include "mapping3d/voxels/floor_plan.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

struct ConvertOptions {
  std::string from;
  std::string to;
  std::optional<double> low_m;
  std::optional<double> high_m;
};

void writePlan(const common::VoxelMap& map, const ConvertOptions& options) {
  if (!options.low_m || !options.high_m)
    throw common::InputError(common::Problem{
        {}, "convert", "a floor plan needs the heights that it shows", "for instance --low 0.8 --high 1.2"});
  if (*options.low_m > *options.high_m)
    throw common::InputError(
        common::Problem{{}, "--low", fmt::format("{} is above --high {}", *options.low_m, *options.high_m), ""});
  const fs::path yaml = options.to;
  const common::OccupancyGrid plan = mapping3d::floorPlan(map, {*options.low_m, *options.high_m});
  if (knownExtent(plan).empty())
    throw common::InputError(common::Problem{
        {options.from}, "", fmt::format("nothing is known from {} to {} m", *options.low_m, *options.high_m), ""});
  required(interfaces::writeMap(yaml.has_parent_path() ? yaml.parent_path() : ".", yaml.stem().string(), plan));
}

int convert(const ConvertOptions& options) {
  const bool plan = fs::path(options.to).extension() == ".yaml";
  if (!plan) (void)interfaces::octreeFormatOf(options.to);  // Before the work.
  if (!plan && (options.low_m || options.high_m))
    throw common::InputError(common::Problem{{}, "--low", "heights are those of a floor plan", "name it .yaml"});
  const common::VoxelMap map = interfaces::readOctree(options.from);
  if (plan)
    writePlan(map, options);
  else
    required(interfaces::writeOctree(options.to, map));
  show(fmt::format("written {}\n", options.to));
  return kDone;
}

}  // namespace

void addConvert(Command& program) {
  auto options = std::make_shared<ConvertOptions>();
  Command command = program.command("convert", "Convert a 3D map to another format, or to a floor plan.");
  command.argument("from", options->from, "Octree of OctoMap: .bt or .ot, also compressed by gzip, bzip2 or xz.");
  command.argument("to", options->to,
                   ".bt or .ot: an octree; .yaml: a floor plan as map_server reads it, with a .pgm beside it.");
  command.option("--low", options->low_m, {-1e4, 1e4}, "Lower end of the heights of a floor plan, in metres.");
  command.option("--high", options->high_m, {-1e4, 1e4}, "Upper end.");
  command.footer("Example: swiftlet convert runs/first/map.bt plan.yaml --low 0.8 --high 1.2");
  command.runs([options] { return convert(*options); });
}

}  // namespace swiftlet::apps
