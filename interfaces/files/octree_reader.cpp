#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/printable.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/octree_codes.hpp"
#include "interfaces/files/unpacked_stream.hpp"

namespace swiftlet::interfaces {
namespace {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;
using octree::kDepth;

/// The log odds -2 and 3.5 at which OctoMap clamps, in steps of VoxelMap::kLogOddsStep.
constexpr std::int8_t kFreeEvidence = -40;
constexpr std::int8_t kOccupiedEvidence = 70;

class OctreeReader {
 public:
  OctreeReader(std::string_view bytes, const std::string& name, std::size_t most_blocks)
      : bytes_(bytes), name_(name), most_blocks_(most_blocks), map_(readHeader()) {}

  VoxelMap read() {
    if (place_ == bytes_.size() && nodes_ == 0) return std::move(map_);  // An empty tree.
    const VoxelIndex first{-octree::kMiddle, -octree::kMiddle, -octree::kMiddle};
    if (format_ == OctreeFormat::kBinary)
      readBinary(first, 1 << kDepth);
    else
      readLogOdds(first, 1 << kDepth);
    if (place_ != bytes_.size()) fail(fmt::format("{} bytes follow the tree", bytes_.size() - place_));
    return std::move(map_);
  }

 private:
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const {
    throw common::InputError(common::Problem{{name_}, fmt::format("byte {}", place_), message, hint});
  }

  std::string_view line() {
    const std::size_t end = bytes_.find('\n', place_);
    if (end == std::string_view::npos) fail("the header does not end with a line `data`");
    const std::string_view text = bytes_.substr(place_, end - place_);
    place_ = end + 1;
    return text.ends_with('\r') ? text.substr(0, text.size() - 1) : text;
  }

  /// The empty map of the file's resolution.
  VoxelMap readHeader() {
    const std::string_view magic = line();
    if (magic.starts_with(octree::kBinaryMagic))
      format_ = OctreeFormat::kBinary;
    else if (magic.starts_with(octree::kLogOddsMagic))
      format_ = OctreeFormat::kLogOdds;
    else
      fail(fmt::format("begins with `{}`", common::printable(std::string(magic.substr(0, 40)))),
           fmt::format("an octree of OctoMap begins with `{}` or `{}`", octree::kBinaryMagic, octree::kLogOddsMagic));
    double resolution_m = 0.0;
    for (std::string_view text = line(); text != "data"; text = line()) {
      if (text.starts_with("id ") && text != "id OcTree")
        fail(fmt::format("holds a tree of the kind `{}`", common::printable(std::string(text.substr(3, 40)))),
             "only OcTree is read");
      if (text.starts_with("res ")) resolution_m = number(text.substr(4));
      if (text.starts_with("size ")) nodes_ = number(text.substr(5));
    }
    if (!(resolution_m >= 1e-3 && resolution_m <= 1e3)) fail("the header has no resolution between 0.001 and 1000 m");
    return VoxelMap(resolution_m);
  }

  double number(std::string_view text) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail(fmt::format("`{}` is not a number", common::printable(std::string(text.substr(0, 40)))));
    return value;
  }

  std::string_view take(std::size_t count) {
    if (bytes_.size() - place_ < count) fail("the file is cut within its tree");
    place_ += count;
    return bytes_.substr(place_ - count, count);
  }

  /// The children of an inner node. The depth of the recursion is that of the tree.
  void readBinary(VoxelIndex first, int side) {
    if (side == 1) fail(fmt::format("the tree is deeper than {} levels", kDepth));
    const std::string_view two = take(2);
    const unsigned codes =
        static_cast<unsigned char>(two[0]) | static_cast<unsigned>(static_cast<unsigned char>(two[1])) << 8;
    const int half = side / 2;
    for (int child = 0; child < 8; ++child) {
      const VoxelIndex below = octree::childOf(first, half, child);
      const unsigned code = codes >> 2 * child & 3;
      if (code == octree::kInnerChild) readBinary(below, half);
      if (code == octree::kFreeChild) fill(below, half, kFreeEvidence);
      if (code == octree::kOccupiedChild) fill(below, half, kOccupiedEvidence);
    }
  }

  /// A node and what is below it.
  void readLogOdds(VoxelIndex first, int side) {
    const std::string_view node = take(sizeof(float) + 1);
    float log_odds = 0.0F;
    std::memcpy(&log_odds, node.data(), sizeof log_odds);
    const auto children = static_cast<unsigned char>(node[sizeof log_odds]);
    if (!std::isfinite(log_odds)) fail("a node has log odds that are not a finite number");
    if (children == 0) return fill(first, side, evidenceOf(log_odds));
    if (side == 1) fail(fmt::format("the tree is deeper than {} levels", kDepth));
    for (int child = 0; child < 8; ++child)
      if ((children >> child & 1) != 0) readLogOdds(octree::childOf(first, side / 2, child), side / 2);
  }

  /// A log odds just above 0 stays above, so that what is occupied stays so.
  static std::int8_t evidenceOf(float log_odds) {
    const double steps = std::clamp(static_cast<double>(log_odds) / VoxelMap::kLogOddsStep, -127.0, 127.0);
    const auto rounded = static_cast<std::int8_t>(std::lround(steps));
    return rounded == 0 && log_odds > 0.0F ? std::int8_t{1} : rounded;
  }

  void fill(VoxelIndex first, int side, std::int8_t evidence) {
    if (side < VoxelBlock::kSide) {
      fillWithin(map_.mutableBlock(VoxelMap::blockOf(first)), first, side, evidence);
      return requireRoom(0.0);
    }
    const VoxelIndex from = VoxelMap::blockOf(first);
    const int blocks = side / VoxelBlock::kSide;
    requireRoom(std::pow(blocks, 3));
    for (int z = 0; z < blocks; ++z)
      for (int y = 0; y < blocks; ++y)
        for (int x = 0; x < blocks; ++x)
          map_.mutableBlock({from.x + x, from.y + y, from.z + z}).evidence.fill(evidence);
  }

  void requireRoom(double more_blocks) const {
    if (static_cast<double>(map_.blockCount()) + more_blocks > static_cast<double>(most_blocks_))
      fail(fmt::format("the tree fills more than {} blocks of 8 x 8 x 8 voxels", most_blocks_));
  }

  void fillWithin(VoxelBlock& block, VoxelIndex first, int side, std::int8_t evidence) const {
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
          block.evidence[static_cast<std::size_t>(VoxelBlock::offsetOf({first.x + x, first.y + y, first.z + z}))] =
              evidence;
  }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t most_blocks_;
  std::size_t place_ = 0;
  double nodes_ = 0.0;  ///< As the header says; it does not have to.
  OctreeFormat format_ = OctreeFormat::kBinary;
  VoxelMap map_;
};

}  // namespace

common::VoxelMap parseOctree(std::string_view bytes, const std::string& name, std::size_t most_blocks) {
  return OctreeReader(bytes, name, most_blocks).read();
}

common::VoxelMap readOctree(const std::filesystem::path& file, std::size_t most_blocks) {
  return parseOctree(readUnpacked(file), file.string(), most_blocks);
}

}  // namespace swiftlet::interfaces
