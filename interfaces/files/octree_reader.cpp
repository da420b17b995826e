#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/printable.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/octree_codes.hpp"
#include "interfaces/files/unpacked_stream.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Message;
using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;
using octree::kDepth;

/// The log odds -2 and 3.5 at which OctoMap clamps, in steps of VoxelMap::kLogOddsStep.
constexpr std::int8_t kFreeEvidence = -40;
constexpr std::int8_t kOccupiedEvidence = 70;

constexpr std::string_view kBlanks = " \t\r\n";

/// What a node of a .ot file holds before the byte of its children.
enum class NodeContent { kLogOdds, kLogOddsAndColor, kCount };

/// The names of trees in headers. "1" is the name of OcTree in OctoMap before 1.4.
constexpr std::array<std::pair<std::string_view, NodeContent>, 5> kTrees{
    {{"OcTree", NodeContent::kLogOdds},
     {"1", NodeContent::kLogOdds},
     {"OcTreeStamped", NodeContent::kLogOdds},
     {"ColorOcTree", NodeContent::kLogOddsAndColor},
     {"CountingOcTree", NodeContent::kCount}}};

std::string shown(std::string_view text) { return common::printable(std::string(text.substr(0, 40))); }

class OctreeReader {
 public:
  OctreeReader(std::string_view bytes, const std::string& name, std::size_t most_blocks)
      : bytes_(bytes), name_(name), most_blocks_(most_blocks) {
    readHeader();
    octree_.map = VoxelMap(resolution_m_);
  }

  StoredOctree read() {
    const bool empty = bytes_.find_first_not_of(kBlanks, place_) == std::string_view::npos;
    if (empty && stated_nodes_.value_or(0.0) == 0.0) return std::move(octree_);
    const VoxelIndex first{-octree::kMiddle, -octree::kMiddle, -octree::kMiddle};
    if (format_ == OctreeFormat::kBinary)
      readBinary(first, 1 << kDepth);
    else
      readNode(first, 1 << kDepth);
    checkEnd();
    return std::move(octree_);
  }

 private:
  [[noreturn]] void fail(Message message, std::string hint = "") const {
    throw common::InputError({name_}, fmt::format("byte {}", place_), std::move(message), std::move(hint));
  }
  [[noreturn]] void failAtHeader() const {
    fail(Message("octree.header-open", "the header does not end with a line `data`"));
  }

  std::string_view line() {
    const std::size_t end = bytes_.find('\n', place_);
    if (end == std::string_view::npos) failAtHeader();
    const std::string_view text = bytes_.substr(place_, end - place_);
    place_ = end + 1;
    return text;
  }

  /// The next word, on this line or a later one, as OctoMap reads a header.
  std::string_view word() {
    const std::size_t begin = bytes_.find_first_not_of(kBlanks, place_);
    const std::size_t end = bytes_.find_first_of(kBlanks, begin);
    if (end == std::string_view::npos) failAtHeader();
    place_ = end;
    return bytes_.substr(begin, end - begin);
  }

  /// The first files of OctoMap have three numbers before the tree: its kind, which is 3, the resolution and its nodes.
  bool readNumbersOnly() {
    constexpr std::string_view kKind("\3\0\0\0", 4);
    if (!bytes_.starts_with(kKind)) return false;
    place_ = kKind.size();
    const std::string_view resolution = take(sizeof resolution_m_), nodes = take(4);
    std::memcpy(&resolution_m_, resolution.data(), resolution.size());
    std::uint32_t stated = 0;
    std::memcpy(&stated, nodes.data(), nodes.size());
    stated_nodes_ = stated;
    format_ = OctreeFormat::kBinary;
    return true;
  }

  void readHeader() {
    if (!readNumbersOnly()) readLines();
    if (!(resolution_m_ >= 1e-3 && resolution_m_ <= 1e3))
      fail(Message("octree.resolution", "the header has no resolution between 0.001 and 1000 m"));
  }

  void readLines() {
    if (!bytes_.starts_with('#')) refuseStart(bytes_.substr(0, bytes_.find_first_of("\r\n")));
    const std::string_view magic = line();
    if (magic.starts_with(octree::kBinaryMagic))
      format_ = OctreeFormat::kBinary;
    else if (magic.starts_with(octree::kLogOddsMagic))
      format_ = OctreeFormat::kLogOdds;
    else
      refuseStart(magic);
    std::string_view id = kTrees[0].first;
    for (std::string_view key = word(); key != "data"; key = word()) {
      if (key == "id")
        id = word();
      else if (key == "res")
        resolution_m_ = number(word());
      else if (key == "size")
        stated_nodes_ = number(word());
      else
        line();  // A comment, or what other programs add.
    }
    line();
    setKind(id);
  }

  [[noreturn]] void refuseStart(std::string_view start) const {
    if (bytes_.empty()) fail(Message("octree.empty", "the file is empty"));
    fail(Message("octree.other-begin", "begins with `{}`", shown(start)),
         fmt::format("an octree of OctoMap begins with `{}` or `{}`", octree::kBinaryMagic, octree::kLogOddsMagic));
  }

  /// In a .bt file all kinds of trees are alike.
  void setKind(std::string_view id) {
    const auto* const found =
        std::find_if(kTrees.begin(), kTrees.end(), [&](const auto& tree) { return tree.first == id; });
    known_kind_ = found != kTrees.end();
    if (known_kind_)
      content_ = found->second;
    else if (format_ == OctreeFormat::kLogOdds)
      fail(Message("octree.other-kind", "holds a tree of the kind `{}`", shown(id)),
           "OcTree, ColorOcTree, OcTreeStamped and CountingOcTree are read of .ot files, and any kind of .bt files, "
           "which writeBinary() of OctoMap's trees writes");
    if (format_ == OctreeFormat::kLogOdds && content_ == NodeContent::kCount)
      octree_.notes.push_back("the tree holds counts: voxels with a count are occupied, nothing is known to be free");
  }

  double number(std::string_view text) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail(Message("text.not-a-number", "`{}` is not a number", shown(text)));
    return value;
  }

  /// Something after the tree is left out, unless it may be the rest of a tree of another kind or of a damaged one.
  void checkEnd() {
    const std::size_t rest = bytes_.find_first_not_of(kBlanks, place_);
    const std::size_t left = rest == std::string_view::npos ? 0 : bytes_.size() - rest;
    const bool as_stated = !stated_nodes_ || *stated_nodes_ == static_cast<double>(nodes_);
    if (left != 0 && !known_kind_)
      fail(Message("octree.unknown-rest", "{} bytes follow the tree, of a kind that is not known", left));
    if (left != 0 && !as_stated)
      fail(Message("octree.rest", "{} bytes follow the tree, which has {} nodes, not {} as its header says", left,
                   nodes_, *stated_nodes_),
           "it is damaged: get the file again");
    if (left != 0) octree_.notes.push_back(fmt::format("{} bytes after the tree left out", left));
    if (!as_stated)
      octree_.notes.push_back(fmt::format("the tree has {} nodes, its header says {}", nodes_, *stated_nodes_));
  }

  std::string_view take(std::size_t count) {
    if (bytes_.size() - place_ < count) fail(Message("octree.cut", "the file is cut within its tree"));
    place_ += count;
    return bytes_.substr(place_ - count, count);
  }

  void requireDepth(int side) const {
    if (side == 1) fail(Message("octree.too-deep", "the tree is deeper than {} levels", kDepth));
  }

  /// The children of an inner node. The depth of the recursion is that of the tree.
  void readBinary(VoxelIndex first, int side) {
    requireDepth(side);
    const std::string_view two = take(2);
    const unsigned codes =
        static_cast<unsigned char>(two[0]) | static_cast<unsigned>(static_cast<unsigned char>(two[1])) << 8;
    const int half = side / 2;
    ++nodes_;
    for (int child = 0; child < 8; ++child) {
      const VoxelIndex below = octree::childOf(first, half, child);
      const unsigned code = codes >> 2 * child & 3;
      if (code == octree::kInnerChild) readBinary(below, half);
      if (code == octree::kFreeChild || code == octree::kOccupiedChild) {
        fill(below, half, code == octree::kFreeChild ? kFreeEvidence : kOccupiedEvidence);
        ++nodes_;
      }
    }
  }

  /// A node of a .ot file and what is below it.
  void readNode(VoxelIndex first, int side) {
    const std::int8_t evidence = readEvidence();
    const std::string_view color = content_ == NodeContent::kLogOddsAndColor ? take(3) : "";
    const auto children = static_cast<unsigned char>(take(1)[0]);
    ++nodes_;
    if (children == 0) {
      if (evidence != VoxelBlock::kUnknown) fill(first, side, evidence);
      if (evidence > 0 && !color.empty()) octree_.colors.push_back({first, side, rgbOf(color)});
      return;
    }
    requireDepth(side);
    for (int child = 0; child < 8; ++child)
      if ((children >> child & 1) != 0) readNode(octree::childOf(first, side / 2, child), side / 2);
  }

  std::int8_t readEvidence() {
    const std::string_view bytes = take(sizeof(float));
    if (content_ == NodeContent::kCount)
      return bytes == std::string_view("\0\0\0\0", 4) ? VoxelBlock::kUnknown : kOccupiedEvidence;
    float log_odds = 0.0F;
    std::memcpy(&log_odds, bytes.data(), sizeof log_odds);
    if (!std::isfinite(log_odds))
      fail(Message("octree.not-finite", "a node has log odds that are not a finite number"));
    return evidenceOf(log_odds);
  }

  static std::array<std::uint8_t, 3> rgbOf(std::string_view color) {
    return {static_cast<std::uint8_t>(color[0]), static_cast<std::uint8_t>(color[1]),
            static_cast<std::uint8_t>(color[2])};
  }

  /// What is occupied stays so: log odds of 0 and more to OctoMap, above 0 to a VoxelMap.
  static std::int8_t evidenceOf(float log_odds) {
    const double steps = std::clamp(static_cast<double>(log_odds) / VoxelMap::kLogOddsStep, -127.0, 127.0);
    const auto rounded = static_cast<std::int8_t>(std::lround(steps));
    return rounded == 0 && log_odds >= 0.0F ? std::int8_t{1} : rounded;
  }

  void fill(VoxelIndex first, int side, std::int8_t evidence) {
    if (side < VoxelBlock::kSide) {
      fillWithin(octree_.map.mutableBlock(VoxelMap::blockOf(first)), first, side, evidence);
      return requireRoom(0.0);
    }
    const VoxelIndex from = VoxelMap::blockOf(first);
    const int blocks = side / VoxelBlock::kSide;
    requireRoom(std::pow(blocks, 3));
    for (int z = 0; z < blocks; ++z)
      for (int y = 0; y < blocks; ++y)
        for (int x = 0; x < blocks; ++x)
          octree_.map.mutableBlock({from.x + x, from.y + y, from.z + z}).evidence.fill(evidence);
  }

  void requireRoom(double more_blocks) const {
    if (static_cast<double>(octree_.map.blockCount()) + more_blocks > static_cast<double>(most_blocks_))
      fail(Message("octree.too-large", "the tree fills more than {} blocks of 8 x 8 x 8 voxels", most_blocks_));
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
  std::size_t nodes_ = 0;               ///< So many were read.
  std::optional<double> stated_nodes_;  ///< As the header says; it does not have to.
  double resolution_m_ = 0.0;
  OctreeFormat format_ = OctreeFormat::kBinary;
  NodeContent content_ = NodeContent::kLogOdds;
  bool known_kind_ = true;
  StoredOctree octree_{VoxelMap(1.0), {}, {}};
};

}  // namespace

std::vector<common::SurfacePoint> coloredCenters(const StoredOctree& octree) {
  std::vector<common::SurfacePoint> points;
  for (const auto& [first, side, rgb] : octree.colors)
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
          points.push_back({octree.map.centerOf({first.x + x, first.y + y, first.z + z}).cast<float>(),
                            Eigen::Vector3f::Zero(), rgb});
  return points;
}

StoredOctree parseOctree(std::string_view bytes, const std::string& name, std::size_t most_blocks) {
  return OctreeReader(bytes, name, most_blocks).read();
}

StoredOctree readOctree(const std::filesystem::path& file, std::size_t most_blocks) {
  return parseOctree(readUnpacked(file), file.string(), most_blocks);
}

}  // namespace swiftlet::interfaces
