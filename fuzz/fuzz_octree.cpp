// links: interfaces common
// Any bytes as an octree: refused as InputError, or a map that is written and read back as the same map.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "common/error.hpp"
#include "interfaces/files/octomap.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  try {
    const interfaces::StoredOctree octree =
        interfaces::parseOctree(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz", 1000);
    const common::VoxelMap& map = octree.map;
    for (const common::SurfacePoint& point : interfaces::coloredCenters(octree))
      if (!map.isOccupied(map.voxelAt(point.position_m.cast<double>()))) std::abort();
    const std::string written = interfaces::toOctree(map, interfaces::OctreeFormat::kLogOdds);
    const common::VoxelMap again = interfaces::parseOctree(written, "written", 1000).map;
    if (again.blocks() != map.blocks()) std::abort();
    for (const common::VoxelIndex block : map.blocks())
      if (again.block(block)->evidence != map.block(block)->evidence) std::abort();
  } catch (const common::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
  return 0;
}
