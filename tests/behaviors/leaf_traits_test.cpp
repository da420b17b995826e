// The table of what the leaves of a mission do.
#include <filesystem>

#include <gtest/gtest.h>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/registry.hpp"
#include "behaviors/tree/parser.hpp"

namespace swiftlet::behaviors::testing {
namespace {

TEST(LeafTraits, HaveALineForEveryLeaf) {
  const tree::Registry engine = tree::Registry::standard();
  for (const auto& [id, type] : missionRegistry().types())
    EXPECT_EQ(findTraits(id) == nullptr, engine.find(id) != nullptr) << id;
}

TEST(LeafTraits, SayWhichLeavesHaveTheVehicle) {
  int leaves = 0;
  for (const char* folder : {"/missions", "/trials/missions"})
    for (const auto& entry : std::filesystem::directory_iterator(std::string(SWIFTLET_SOURCE_DIR) + folder)) {
      if (entry.path().extension() != ".xml") continue;
      const tree::ParseResult parsed = tree::parseFile(entry.path().string(), missionRegistry());
      ASSERT_TRUE(parsed.tree) << entry.path();
      for (const tree::NodeRecord& record : parsed.tree->nodes()) {
        const bool flies = dynamic_cast<const FlightLeaf*>(record.node) != nullptr && !record.manifest->may_skip;
        EXPECT_EQ(traitsOf(record).vehicle != VehicleUse::kNone, flies) << record.node->name();
        leaves += flies ? 1 : 0;
      }
    }
  EXPECT_GT(leaves, 50);
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
