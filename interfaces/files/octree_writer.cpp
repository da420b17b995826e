#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/octree_codes.hpp"

namespace swiftlet::interfaces {
namespace {

using common::InputError;
using common::Message;
using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;
using octree::kBlockDepth;
using octree::kDepth;

/// A node, after its bytes and those of all nodes below it were written.
struct Node {
  enum class Kind { kUnknown, kLeaf, kInner } kind = Kind::kUnknown;
  std::int8_t evidence = 0;  ///< Of a leaf its own, of an inner node the greatest below it.
};

float logOdds(std::int8_t evidence) {
  return evidence == 0 ? octree::kJustFree : static_cast<float>(evidence * VoxelMap::kLogOddsStep);
}

/// Bits of x, y and z in turn, x lowest: the order in which a tree visits its nodes.
std::uint64_t mortonCode(VoxelIndex block) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < kBlockDepth; ++bit) {
    const auto part = [bit](int number, int shift) {
      return static_cast<std::uint64_t>(number >> bit & 1) << (3 * bit + shift);
    };
    code |= part(block.x, 0) | part(block.y, 1) | part(block.z, 2);
  }
  return code;
}

/// Writes nodes from the root down, each before its children. Nodes of one content are cut off again (pruned) when all
/// of their children have been written.
class OctreeWriter {
 public:
  OctreeWriter(const VoxelMap& map, OctreeFormat format) : map_(map), format_(format) {
    constexpr int kShift = octree::kMiddle / VoxelBlock::kSide;
    for (const VoxelIndex block : map.blocks()) {
      const VoxelIndex shifted{block.x + kShift, block.y + kShift, block.z + kShift};
      for (const int number : {shifted.x, shifted.y, shifted.z})
        if (number < 0 || number >= 2 * kShift)
          throw InputError(
              {}, "octree",
              Message("octree.map-too-wide", "the map reaches beyond {:.0f} m", octree::kMiddle * map.resolution_m()));
      blocks_.push_back({mortonCode(shifted), map.block(block)});
    }
    std::sort(blocks_.begin(), blocks_.end(), [](const Block& a, const Block& b) { return a.code < b.code; });
  }

  std::string write() {
    writeInner(0, 0, blocks_.size());
    const bool binary = format_ == OctreeFormat::kBinary;
    // In place: the bytes of a large building's tree would take three times as much memory on the way.
    bytes_.insert(
        0, fmt::format("{}\n# (feel free to add / change comments, but leave the first line as it is!)\n#\nid OcTree\n"
                       "size {}\nres {}\ndata\n",
                       binary ? octree::kBinaryMagic : octree::kLogOddsMagic, nodes_, map_.resolution_m()));
    return std::move(bytes_);
  }

 private:
  struct Block {
    std::uint64_t code;
    const VoxelBlock* block;
  };

  /// The node at that depth over blocks [begin, end) of the sorted list.
  Node writeInner(int depth, std::size_t begin, std::size_t end) {
    if (begin == end) return {};
    if (depth == kBlockDepth) return writeCube(*blocks_[begin].block, {0, 0, 0}, VoxelBlock::kSide);
    std::array<Node, 8> children;
    const std::size_t place = beginNode();
    const int shift = 3 * (kBlockDepth - 1 - depth);
    std::size_t first = begin;
    for (std::uint64_t child = 0; child < 8; ++child) {
      std::size_t last = first;
      while (last < end && (blocks_[last].code >> shift & 7) == child) ++last;
      children[child] = writeInner(depth + 1, first, last);
      first = last;
    }
    // A tree of one leaf has no place in the .bt format; OctoMap never prunes that far in practice.
    return endNode(place, children, depth > 0);
  }

  /// A cube of voxels within a block.
  Node writeCube(const VoxelBlock& block, VoxelIndex first, int side) {
    if (side == 1) return writeVoxel(block.evidence[static_cast<std::size_t>(VoxelBlock::offsetOf(first))]);
    std::array<Node, 8> children;
    const std::size_t place = beginNode();
    for (int child = 0; child < 8; ++child)
      children[static_cast<std::size_t>(child)] = writeCube(block, octree::childOf(first, side / 2, child), side / 2);
    return endNode(place, children, true);
  }

  Node writeVoxel(std::int8_t evidence) {
    if (evidence == VoxelBlock::kUnknown) return {};
    return writeLeaf(evidence);
  }

  /// A leaf is bytes of its own in a .ot file, and two bits of its parent in a .bt file.
  Node writeLeaf(std::int8_t evidence) {
    ++nodes_;
    if (format_ == OctreeFormat::kLogOdds) {
      appendFloat(logOdds(evidence));
      bytes_ += '\0';
      return {Node::Kind::kLeaf, evidence};
    }
    return {Node::Kind::kLeaf, static_cast<std::int8_t>(evidence > 0 ? 1 : 0)};
  }

  std::size_t beginNode() {
    const std::size_t place = bytes_.size();
    bytes_.append(format_ == OctreeFormat::kBinary ? 2 : sizeof(float) + 1, '\0');
    ++nodes_;
    return place;
  }

  /// Fills in the node at `place`, or cuts it off if it is unknown or all its children are equal leaves.
  Node endNode(std::size_t place, const std::array<Node, 8>& children, bool may_prune) {
    const auto equal = [&](const Node& child) {
      return child.kind == children[0].kind && child.evidence == children[0].evidence;
    };
    const bool same = children[0].kind != Node::Kind::kInner && std::all_of(children.begin(), children.end(), equal);
    if (same && (may_prune || children[0].kind == Node::Kind::kUnknown)) {
      bytes_.resize(place);
      nodes_ -= children[0].kind == Node::Kind::kLeaf ? 9 : 1;
      return children[0].kind == Node::Kind::kLeaf ? writeLeaf(children[0].evidence) : Node{};
    }
    Node node{Node::Kind::kInner, VoxelBlock::kUnknown};
    unsigned codes = 0, exist = 0;
    for (std::size_t child = 0; child < 8; ++child) {
      const Node& of = children[child];
      if (of.kind == Node::Kind::kUnknown) continue;
      exist |= 1U << child;
      codes |= static_cast<unsigned>(of.kind == Node::Kind::kInner ? octree::kInnerChild
                                     : of.evidence > 0             ? octree::kOccupiedChild
                                                                   : octree::kFreeChild)
               << 2 * child;
      node.evidence = std::max(node.evidence, of.evidence);
    }
    if (format_ == OctreeFormat::kBinary) {
      bytes_[place] = static_cast<char>(codes & 255);
      bytes_[place + 1] = static_cast<char>(codes >> 8);
    } else {
      const float value = logOdds(node.evidence);
      std::memcpy(&bytes_[place], &value, sizeof value);
      bytes_[place + sizeof value] = static_cast<char>(exist);
    }
    return node;
  }

  void appendFloat(float value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    bytes_.append(bytes, sizeof value);
  }

  const VoxelMap& map_;
  OctreeFormat format_;
  std::vector<Block> blocks_;
  std::string bytes_;
  std::size_t nodes_ = 0;
};

}  // namespace

OctreeFormat octreeFormatOf(const std::filesystem::path& file) {
  const std::string ending = common::endingOf(file);
  if (ending == ".bt") return OctreeFormat::kBinary;
  if (ending == ".ot") return OctreeFormat::kLogOdds;
  throw InputError({file.string()}, "",
                   Message("octree.other-ending", "the ending `{}` is not one of an octree", file.extension().string()),
                   "name it .bt or .ot");
}

std::string toOctree(const VoxelMap& map, OctreeFormat format) { return OctreeWriter(map, format).write(); }

Written writeOctree(const std::filesystem::path& file, const VoxelMap& map) {
  return writeAtomically(file, toOctree(map, octreeFormatOf(file)));
}

}  // namespace swiftlet::interfaces
