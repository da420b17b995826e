// Octrees that OctoMap itself reads and writes.
#include "interfaces/files/octomap.hpp"

#include <octomap/octomap.h>

#include <cstdlib>
#include <memory>
#include <random>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/interfaces/octomap_reader.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::interfaces {
namespace {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;
using test_support::ProblemIs;
using test_support::problemsOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Cubes of one value, so that something can be pruned, and single voxels, on all sides of the origin.
VoxelMap randomMap(unsigned seed) {
  VoxelMap map(0.05);
  std::mt19937 random(seed);
  const auto number = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low));
  };
  for (int cube = 0; cube < 40; ++cube) {
    const int side = 1 << number(0, 6);
    const auto evidence = static_cast<std::int8_t>(number(-40, 70));
    const VoxelIndex first{number(-60, 60) / side * side, number(-60, 60) / side * side, number(-20, 20) / side * side};
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) map.set({first.x + x, first.y + y, first.z + z}, evidence);
  }
  return map;
}

/// Every voxel of the map, and as many of the tree.
void expectSame(const VoxelMap& map, octomap::OcTree& tree, OctreeFormat format) {
  tree.expand();
  std::size_t known = 0;
  for (const VoxelIndex block : map.blocks()) {
    for (int i = 0; i < VoxelBlock::kVoxels; ++i) {
      const VoxelIndex voxel = VoxelMap::voxelOf(block, i);
      const Eigen::Vector3d center_m = map.centerOf(voxel);
      const octomap::OcTreeNode* node = tree.search(center_m.x(), center_m.y(), center_m.z());
      ASSERT_EQ(node != nullptr, map.isKnown(voxel));
      if (node == nullptr) continue;
      ++known;
      ASSERT_EQ(tree.isNodeOccupied(node), map.isOccupied(voxel));
      if (format == OctreeFormat::kLogOdds) {
        ASSERT_NEAR(node->getLogOdds(), map.evidence(voxel) * VoxelMap::kLogOddsStep, 1e-6);
      }
    }
  }
  EXPECT_EQ(tree.getNumLeafNodes(), known);
}

class OctreeFile : public testing::TestWithParam<OctreeFormat> {};
INSTANTIATE_TEST_SUITE_P(Formats, OctreeFile, testing::Values(OctreeFormat::kBinary, OctreeFormat::kLogOdds));

TEST_P(OctreeFile, IsReadByOctomap) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const VoxelMap map = randomMap(seed);
    const auto tree = asOctomapReads(toOctree(map, GetParam()), GetParam());
    ASSERT_TRUE(tree);
    const std::size_t leaves = tree->getNumLeafNodes();
    tree->prune();
    EXPECT_EQ(tree->getNumLeafNodes(), leaves) << "it was pruned already";
    expectSame(map, *tree, GetParam());
  }
}

TEST_P(OctreeFile, IsReadAgainAsItWas) {
  for (unsigned seed = 11; seed <= 15; ++seed) {
    const VoxelMap map = randomMap(seed);
    const VoxelMap again = parseOctree(toOctree(map, GetParam()), "again").map;
    EXPECT_EQ(again.blocks(), map.blocks());
    for (const VoxelIndex block : map.blocks()) {
      for (std::size_t i = 0; i < VoxelBlock::kVoxels; ++i) {
        const std::int8_t before = map.block(block)->evidence[i], after = again.block(block)->evidence[i];
        if (GetParam() == OctreeFormat::kLogOdds || before == VoxelBlock::kUnknown)
          ASSERT_EQ(after, before);
        else
          ASSERT_EQ(after, before > 0 ? 70 : -40);
      }
    }
  }
}

TEST_P(OctreeFile, IsWrittenAsOctomapWritesIt) {
  const VoxelMap map = randomMap(21);
  const std::string bytes = toOctree(map, GetParam());
  const auto tree = asOctomapReads(bytes, GetParam());
  ASSERT_TRUE(tree);
  std::ostringstream stream;
  if (GetParam() == OctreeFormat::kBinary)
    ASSERT_TRUE(tree->writeBinaryConst(stream));
  else
    ASSERT_TRUE(tree->write(stream));
  const std::string theirs = stream.str();
  EXPECT_EQ(bytes.substr(bytes.find("\ndata\n")), theirs.substr(theirs.find("\ndata\n")));
  EXPECT_EQ(bytes.substr(bytes.find("\nid ")), theirs.substr(theirs.find("\nid ")));
}

TEST_P(OctreeFile, AnEmptyMapIsAnEmptyTree) {
  const std::string bytes = toOctree(VoxelMap(0.05), GetParam());
  EXPECT_THAT(bytes, HasSubstr("\nsize 0\n"));
  EXPECT_EQ(parseOctree(bytes, "empty").map.blockCount(), 0u);
}

TEST_P(OctreeFile, ThatIsCutIsRefusedWithItsPlace) {
  const std::string bytes = toOctree(randomMap(1), GetParam());
  const std::size_t tree = bytes.find("\ndata\n") + 6;
  for (const std::size_t length : {std::size_t{0}, std::size_t{20}, tree, bytes.size() / 2, bytes.size() - 1}) {
    const auto problems = problemsOf([&] { (void)parseOctree(bytes.substr(0, length), "cut.bt"); });
    ASSERT_EQ(problems.size(), 1U) << length;
    EXPECT_TRUE(test_support::placeOf(problems[0]).starts_with("cut.bt: byte ")) << length;
  }
}

void expectRefused(const std::string& bytes, const std::string& name, const std::string& says = "") {
  EXPECT_THAT(problemsOf([&] { (void)parseOctree(bytes, "bad.bt", 1000); }), ElementsAre(ProblemIs(name, "", says)));
}

TEST(BadOctree, NamesWhatIsWrong) {
  const std::string header = "# Octomap OcTree binary file\nid OcTree\nsize 1\nres 0.05\ndata\n";
  expectRefused("ply\n", "octree.other-begin", "`ply`");
  expectRefused("# Octomap OcTree file\nid SemanticOcTree\nres 0.05\ndata\n", "octree.other-kind", "`SemanticOcTree`");
  expectRefused("# Octomap OcTree file\nid SemanticOcTree\nres 0.05\ndata\n", "octree.other-kind",
                "OcTree, ColorOcTree, OcTreeStamped");
  expectRefused("# Octomap OcTree binary file\nid OcTree\nres zero\ndata\n", "text.not-a-number", "`zero`");
  expectRefused("# Octomap OcTree binary file\nid OcTree\nsize 1\ndata\n", "octree.resolution");
  expectRefused(header + std::string(100'000, '\xff'), "octree.too-deep");
  expectRefused(header + std::string("\x02\x00", 2), "octree.too-large");
  expectRefused(header + std::string("\x03\x00\x00\x00\xff", 5), "octree.rest");
  // Of leaves that are smaller than a block, each may be in a block of its own.
  common::VoxelMap scattered(0.05);
  for (int i = 0; i < 1001; ++i) scattered.set({common::VoxelBlock::kSide * i, 0, 0}, 10);
  for (const OctreeFormat format : {OctreeFormat::kBinary, OctreeFormat::kLogOdds})
    expectRefused(toOctree(scattered, format), "octree.too-large");
}

TEST(OctreeFiles, OfOthersKeepTheirLeaves) {
  const char* folder = std::getenv("SWIFTLET_DATASETS");
  const std::filesystem::path data = folder ? folder : std::string(SWIFTLET_SOURCE_DIR) + "/../shared/datasets";
  const std::filesystem::path file = data / "07-octomap/slambook-dense/octomap.bt.gz";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no data set " << file << "; set SWIFTLET_DATASETS";
  const VoxelMap map = readOctree(file).map;
  const std::string bytes = toOctree(map, OctreeFormat::kBinary);
  EXPECT_THAT(bytes, HasSubstr("\nsize 146768\n"));  // As the file's own header says.
  const auto tree = asOctomapReads(bytes, OctreeFormat::kBinary);
  ASSERT_TRUE(tree);
  expectSame(map, *tree, OctreeFormat::kBinary);
}

}  // namespace
}  // namespace swiftlet::interfaces
