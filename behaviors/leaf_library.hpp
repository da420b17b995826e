// Leaves of one's own in a shared object, for `swiftlet fly --leaves libmine.so`. It has this entry alone:
//
//   extern "C" swiftlet::behaviors::LeafLibrary swiftlet_leaves() {
//     return swiftlet::behaviors::leafLibrary([](swiftlet::tree::Registry& leaves) { leaves.add<Circle>(); });
//   }
//
// It links swiftlet::behaviors, as it is installed with the program that loads it. Objects of C++ cross between the
// two, so both must be built from the same release by the same compiler; the program refuses any other library.
#pragma once

#include <cstddef>

#include "behaviors/flight_tick.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/tree/registry.hpp"
#include "common/intent.hpp"
#include "common/world.hpp"

namespace swiftlet::behaviors {

/// The release of the library swiftlet::behaviors, and its compiler: "0.2.0 (g++ 12.2.0)".
const char* leafRelease();

/// Differs where a type that crosses has another size.
inline constexpr std::size_t kLeafLayout = [] {
  std::size_t layout = 0;
  for (const std::size_t size :
       {sizeof(tree::Registry), sizeof(tree::NodeManifest), sizeof(tree::PortManifest), sizeof(tree::NodeSetup),
        sizeof(tree::PortBinding), sizeof(tree::Slot), sizeof(tree::Node), sizeof(FlightTick), sizeof(MissionMemory),
        sizeof(Context), sizeof(LeafTraits), sizeof(common::World), sizeof(common::IntentKind),
        sizeof(common::MissionRequest)})
    layout = 31 * layout + size;
  return layout;
}();

/// These fields stay as they are in every release, so that a library of another one can be told.
struct LeafLibrary {
  const char* release;  ///< leafRelease()
  std::size_t layout;   ///< kLeafLayout
  /// Adds the types to a registry that is empty before. It may throw std::exception: the library is then refused.
  void (*add)(tree::Registry& leaves);
};

inline LeafLibrary leafLibrary(void (*add)(tree::Registry& leaves)) { return {leafRelease(), kLeafLayout, add}; }

}  // namespace swiftlet::behaviors

/// The entry, defined by the library.
extern "C" swiftlet::behaviors::LeafLibrary swiftlet_leaves();
