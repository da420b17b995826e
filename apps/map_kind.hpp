// What of a building a file holds.
#pragma once

#include <string>

namespace swiftlet::apps {

enum class MapKind {
  kFloorPlan,  ///< A .yaml as map_server reads it, or its picture.
  kOctree,     ///< .bt, .ot.
  kCloud,      ///< .ply, .pcd.
  kGrid,       ///< A .map of the Moving AI benchmarks, which has no metres.
};

/// By the ending, in any case, also that of a packed file. Throws InputError that names the kinds.
MapKind mapKindOf(const std::string& file);

}  // namespace swiftlet::apps
