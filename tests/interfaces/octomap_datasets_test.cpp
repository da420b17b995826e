// The octrees of others: read, converted and saved with the same leaves and values, with OctoMap as the oracle.
#include <octomap/octomap.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "interfaces/files/octomap.hpp"
#include "tests/interfaces/octomap_reader.hpp"
#include "tests/support/datasets.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;

std::string unpacked(const fs::path& file) {
  std::string bytes;
  const std::string command = "gzip -dc '" + file.string() + "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::array<char, 65536> part{};
  while (const std::size_t read = std::fread(part.data(), 1, part.size(), pipe.get())) bytes.append(part.data(), read);
  return bytes;
}

/// The leaves of both, one after the other: place, size and value, which ours rounds to steps of kLogOddsStep.
void expectSameLeaves(const octomap::OcTree& theirs, const octomap::OcTree& ours) {
  ASSERT_EQ(ours.getNumLeafNodes(), theirs.getNumLeafNodes());
  EXPECT_DOUBLE_EQ(ours.getResolution(), theirs.getResolution());
  auto our_leaf = ours.begin_leafs();
  for (auto leaf = theirs.begin_leafs(); leaf != theirs.end_leafs(); ++leaf, ++our_leaf) {
    ASSERT_EQ(our_leaf.getKey(), leaf.getKey());
    ASSERT_EQ(our_leaf.getDepth(), leaf.getDepth());
    ASSERT_NEAR(our_leaf->getLogOdds(), leaf->getLogOdds(), 0.5 * common::VoxelMap::kLogOddsStep + 1e-6);
  }
}

TEST(OctreesOfOthers, KeepLeavesAndValues) {
  const auto folder = test_support::dataSet("07-octomap");
  if (!folder) return;
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(*folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".bt.gz") && !name.ends_with(".bt")) continue;
    ++files;
    SCOPED_TRACE(name);
    const auto theirs = asOctomapReads(unpacked(entry.path()), OctreeFormat::kBinary);
    ASSERT_TRUE(theirs);
    theirs->prune();
    const common::VoxelMap map = readOctree(entry.path()).map;
    for (const OctreeFormat format : {OctreeFormat::kBinary, OctreeFormat::kLogOdds}) {
      const auto ours = asOctomapReads(toOctree(map, format), format);
      ASSERT_TRUE(ours);
      expectSameLeaves(*theirs, *ours);
      // Saved, read and converted again: the same bytes.
      const common::VoxelMap again = parseOctree(toOctree(map, format), name).map;
      EXPECT_EQ(toOctree(again, OctreeFormat::kLogOdds), toOctree(map, OctreeFormat::kLogOdds));
    }
  }
  EXPECT_GE(files, 2);
}

}  // namespace
}  // namespace swiftlet::interfaces
