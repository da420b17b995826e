#include "apps/map_kind.hpp"

#include <filesystem>

#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "interfaces/clouds/point_cloud.hpp"
#include "interfaces/files/map_picture.hpp"
#include "interfaces/files/unpacked_stream.hpp"

namespace swiftlet::apps {

MapKind mapKindOf(const std::string& file) {
  const std::filesystem::path unpacked = interfaces::unpackedName(file);
  const std::string ending = common::endingOf(unpacked);
  if (ending == ".yaml" || ending == ".yml" || interfaces::isPicture(file)) return MapKind::kFloorPlan;
  if (ending == ".bt" || ending == ".ot") return MapKind::kOctree;
  if (interfaces::cloudFormatOf(unpacked)) return MapKind::kCloud;
  if (ending == ".map") return MapKind::kGrid;
  throw common::InputError(
      {file}, "", common::Message("world.other-kind", "`{}` is not a kind of map", unpacked.extension().string()),
      "a floor plan is a .yaml as map_server reads it, an octree a .bt or .ot, a cloud a .ply or .pcd, a grid of the "
      "Moving AI benchmarks a .map");
}

}  // namespace swiftlet::apps
