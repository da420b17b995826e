// What the checks know of leaves from their manifests.
#include <filesystem>

#include <gtest/gtest.h>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/registry.hpp"
#include "behaviors/tree/parser.hpp"

namespace swiftlet::behaviors::testing {
namespace {

TEST(LeafTraits, SayWhichLeavesHaveTheVehicle) {
  int leaves = 0;
  const tree::Registry registry = missionRegistry();
  for (const char* folder : {"/missions", "/trials/missions"})
    for (const auto& entry : std::filesystem::directory_iterator(std::string(SWIFTLET_SOURCE_DIR) + folder)) {
      if (entry.path().extension() != ".xml") continue;
      const tree::ParseResult parsed = tree::parseFile(entry.path().string(), registry);
      ASSERT_TRUE(parsed.tree) << entry.path();
      for (const tree::NodeRecord& record : parsed.tree->nodes()) {
        const bool flies = dynamic_cast<const FlightLeaf*>(record.node) != nullptr && !record.manifest->may_skip;
        EXPECT_EQ(traitsOf(record).vehicle != VehicleUse::kNone, flies) << record.node->name();
        leaves += flies ? 1 : 0;
      }
    }
  EXPECT_GT(leaves, 50);
}

TEST(Leaves, SayHowTheyEnd) {
  const tree::Registry engine = tree::Registry::standard(), registry = missionRegistry();
  for (const auto& [id, type] : registry.types())
    EXPECT_EQ(type.manifest.ends.empty(), engine.find(id) != nullptr) << id;
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
