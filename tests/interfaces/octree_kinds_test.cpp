// The other kinds of trees of OctoMap, as OctoMap writes them, and headers as others write them.
#include <octomap/ColorOcTree.h>
#include <octomap/OcTreeStamped.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "interfaces/files/octomap.hpp"
#include "tests/support/datasets.hpp"

namespace swiftlet::interfaces {
namespace {

using common::VoxelIndex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Rgb = std::array<std::uint8_t, 3>;

octomap::point3d centerOf(VoxelIndex voxel) {
  const auto at = [](int number) { return 0.1F * (static_cast<float>(number) + 0.5F); };
  return {at(voxel.x), at(voxel.y), at(voxel.z)};
}

/// A free room of 8 x 8 x 2 voxels with a floor, in which `look` says what a voxel of the floor looks like.
template <typename Tree, typename Look>
Tree room(const Look& look) {
  Tree tree(0.1);
  for (int x = -4; x < 4; ++x)
    for (int y = -4; y < 4; ++y) {
      for (int z = 1; z < 3; ++z) tree.updateNode(centerOf({x, y, z}), false);
      tree.updateNode(centerOf({x, y, 0}), true);
      look(tree, VoxelIndex{x, y, 0});
    }
  tree.updateInnerOccupancy();
  return tree;
}

template <typename Tree>
std::string asOt(const Tree& tree) {
  std::ostringstream stream;
  tree.write(stream);
  return stream.str();
}

/// A tree that is known to be `room` has its floor occupied and what is above it free.
void expectRoom(const common::VoxelMap& map) {
  for (int x = -4; x < 4; ++x)
    for (int y = -4; y < 4; ++y) {
      ASSERT_TRUE(map.isOccupied({x, y, 0}));
      ASSERT_TRUE(map.isFree({x, y, 1}));
      ASSERT_FALSE(map.isKnown({x, y, 3}));
    }
}

const auto kPlain = [](auto&, VoxelIndex) {};

TEST(OctreeKinds, AColorOcTreeKeepsItsColoursAsAFileOfPoints) {
  // One quarter of the floor has one colour and is pruned; the rest differs from voxel to voxel.
  const auto colorOf = [](VoxelIndex v) {
    return v.x < 0 && v.y < 0 ? Rgb{255, 0, 0}
                              : Rgb{10, static_cast<std::uint8_t>(v.x + 100), static_cast<std::uint8_t>(v.y + 100)};
  };
  octomap::ColorOcTree tree = room<octomap::ColorOcTree>([&](octomap::ColorOcTree& of, VoxelIndex voxel) {
    const Rgb rgb = colorOf(voxel);
    of.search(centerOf(voxel))->setColor(rgb[0], rgb[1], rgb[2]);
  });
  tree.prune();
  const StoredOctree octree = parseOctree(asOt(tree), "color");
  expectRoom(octree.map);
  EXPECT_THAT(octree.notes, IsEmpty());
  const std::vector<common::SurfacePoint> points = coloredCenters(octree);
  EXPECT_EQ(points.size(), 64U);
  for (const common::SurfacePoint& point : points)
    ASSERT_EQ(point.rgb, colorOf(octree.map.voxelAt(point.position_m.cast<double>()))) << point.position_m.transpose();
}

TEST(OctreeKinds, AllOccupancyTreesOfOctomapAreReadInBothFormats) {
  const auto expectBoth = [](auto tree) {
    SCOPED_TRACE(tree.getTreeType());
    expectRoom(parseOctree(asOt(tree), "log odds").map);
    std::ostringstream binary;
    tree.writeBinary(binary);
    expectRoom(parseOctree(binary.str(), "binary").map);
  };
  expectBoth(room<octomap::OcTree>(kPlain));
  expectBoth(room<octomap::ColorOcTree>(kPlain));
  expectBoth(room<octomap::OcTreeStamped>(kPlain));
}

TEST(OctreeKinds, InACountingOcTreeWhatWasCountedIsOccupied) {
  // Its header is no C++20. The first child of the last one of the root, down to one voxel beside the origin.
  std::string bytes = "# Octomap OcTree file\nid CountingOcTree\nsize 17\nres 0.1\ndata\n";
  const std::string count("\3\0\0\0", 4);
  for (int depth = 0; depth < 16; ++depth) bytes += count + (depth == 0 ? '\x80' : '\x01');
  bytes += count + '\0';
  const StoredOctree octree = parseOctree(bytes, "counts");
  EXPECT_TRUE(octree.map.isOccupied({0, 0, 0}));
  EXPECT_FALSE(octree.map.isKnown({1, 0, 0}));
  EXPECT_THAT(octree.notes, ElementsAre(HasSubstr("counts")));
}

TEST(OctreeKinds, LogOddsOfZeroAreOccupiedAsToOctomap) {
  octomap::OcTree tree(0.1);
  const float values[]{0.0F, -0.001F, 0.001F};
  for (int i = 0; i < 3; ++i) tree.setNodeValue(centerOf({i, 0, 0}), values[i]);
  const common::VoxelMap map = parseOctree(asOt(tree), "zero").map;
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(map.isOccupied({i, 0, 0}), tree.isNodeOccupied(tree.search(centerOf({i, 0, 0})))) << values[i];
}

/// The bytes of a tree whose first `of` is `by` instead.
std::string replaced(std::string bytes, const std::string& of, const std::string& by) {
  return bytes.replace(bytes.find(of), of.size(), by);
}

TEST(OctreeHeaders, AreReadAsOthersWriteThem) {
  const std::string bytes = asOt(room<octomap::OcTree>(kPlain));
  const std::string size = bytes.substr(bytes.find("size "), bytes.find("\nres") - bytes.find("size "));
  const std::map<std::string, std::string> variants{
      {"the name of old files", replaced(bytes, "id OcTree", "id 1")},
      {"no kind", replaced(bytes, "id OcTree\n", "")},
      {"no size", replaced(bytes, size + "\n", "")},
      {"another order", replaced(replaced(bytes, "id OcTree\n", ""), "data\n", "id OcTree\ndata\n")},
      {"blanks", replaced(replaced(bytes, "id OcTree", "  id \t OcTree  "), "data\n", "data \n")},
      {"one line", replaced(replaced(bytes, "id OcTree\n", "id OcTree "), size + "\n", size + " ")},
      {"comments", replaced(bytes, "res 0.1", "# by hand\n\nres 0.1\n#size 7")},
      {"unknown words", replaced(bytes, "res 0.1", "frame map\nres 0.1")},
      {"Windows", replaced(replaced(bytes, "id OcTree\n", "id OcTree\r\n"), "data\n", "data\r\n")},
      {"a last line end", bytes + "\n"},
      {"blanks at the end", bytes + " \r\n"}};
  for (const auto& [name, variant] : variants) {
    SCOPED_TRACE(name);
    const StoredOctree octree = parseOctree(variant, name);
    expectRoom(octree.map);
    EXPECT_THAT(octree.notes, IsEmpty());
  }
}

TEST(OctreeHeaders, MayBeTheThreeNumbersOfTheFirstFiles) {
  auto tree = room<octomap::OcTree>(kPlain);
  std::ostringstream stream;
  tree.writeBinary(stream);
  const std::string bytes = stream.str(), nodes = bytes.substr(bytes.find("data\n") + 5);
  const auto count = static_cast<std::uint32_t>(tree.size());
  std::string head("\3\0\0\0\x9a\x99\x99\x99\x99\x99\xb9\x3f", 12);
  for (int shift = 0; shift < 32; shift += 8) head += static_cast<char>(count >> shift & 0xff);
  const StoredOctree octree = parseOctree(head + nodes, "old");
  expectRoom(octree.map);
  EXPECT_THAT(octree.notes, IsEmpty());
  EXPECT_THROW(parseOctree(head.substr(0, 9), "cut"), common::InputError);
}

TEST(OctreeHeaders, WhatContradictsThemIsSaid) {
  const std::string bytes = asOt(room<octomap::OcTree>(kPlain));
  const std::string size = bytes.substr(bytes.find("size "), bytes.find("\nres") - bytes.find("size "));
  const StoredOctree other_size = parseOctree(replaced(bytes, size, "size 7"), "other size");
  expectRoom(other_size.map);
  EXPECT_THAT(other_size.notes, ElementsAre(HasSubstr("nodes, its header says 7")));
  const StoredOctree longer = parseOctree(bytes + "abc", "longer");
  expectRoom(longer.map);
  EXPECT_THAT(longer.notes, ElementsAre(HasSubstr("3 bytes after the tree left out")));
  EXPECT_THROW(parseOctree(replaced(bytes, size, "size 7") + "abc", "damaged"), common::InputError);
  // A .bt file of a kind that is not known is read if it is one to its last byte.
  auto tree = room<octomap::OcTree>(kPlain);
  std::ostringstream stream;
  tree.writeBinary(stream);
  const std::string semantic = replaced(stream.str(), "id OcTree", "id SemanticOcTree");
  expectRoom(parseOctree(semantic, "semantic").map);
  EXPECT_THROW(parseOctree(semantic + "abc", "semantic"), common::InputError);
}

TEST(OctreeKinds, TheFieldCasesAreRead) {
  const auto folder = test_support::dataSet("10-field-cases/octree_kinds");
  if (!folder) return;
  const StoredOctree old = readOctree(*folder / "id1.ot"), color = readOctree(*folder / "color.ot");
  EXPECT_TRUE(old.colors.empty());
  ASSERT_FALSE(color.colors.empty());
  EXPECT_EQ(color.colors.front().rgb, (Rgb{255, 0, 0}));
  EXPECT_EQ(old.map.blocks(), color.map.blocks());
}

}  // namespace
}  // namespace swiftlet::interfaces
