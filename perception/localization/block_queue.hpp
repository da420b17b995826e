// The blocks of poses that a search of the whole map has still to examine, the one with the highest bound first.
// Private to localization.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

namespace swiftlet::perception {

/// 2^level x 2^level positions of one direction. No pose of the block scores more than `bound`.
struct PoseBlock {
  std::uint16_t bound = 0, direction = 0;
  std::int32_t level = 0, x = 0, y = 0;

  /// Among equal bounds the coarser block comes first, because it may contain a pose that precedes the finer one.
  bool operator<(const PoseBlock& other) const {
    if (bound != other.bound) return bound < other.bound;
    if (level != other.level) return level < other.level;
    return std::tie(other.direction, other.y, other.x) < std::tie(direction, y, x);
  }
};

/// A priority queue with a heap for each bound. A search of a map in which nothing fits holds hundreds of thousands of
/// blocks; in a single heap each step would reach through all of that memory, and most blocks are never examined.
class BlockQueue {
 public:
  explicit BlockQueue(const std::vector<PoseBlock>& blocks) {
    std::vector<std::size_t> counts(std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1);
    for (const PoseBlock& block : blocks) {
      ++counts[block.bound];
      highest_ = std::max<std::size_t>(highest_, block.bound);
    }
    heaps_.resize(highest_ + 1);
    is_heap_.resize(highest_ + 1, false);
    for (std::size_t bound = 0; bound <= highest_; ++bound) heaps_[bound].reserve(counts[bound]);
    for (const PoseBlock& block : blocks) heaps_[block.bound].push_back(block);
  }

  bool empty() {
    while (highest_ > 0 && heaps_[highest_].empty()) --highest_;
    return heaps_[highest_].empty();
  }
  /// The highest bound. The queue must have been found not empty.
  std::int32_t bound() const { return static_cast<std::int32_t>(highest_); }

  /// The first block, which is removed. The queue must have been found not empty.
  PoseBlock take() {
    std::vector<PoseBlock>& heap = heaps_[highest_];
    if (!is_heap_[highest_]) std::make_heap(heap.begin(), heap.end());
    is_heap_[highest_] = true;
    std::pop_heap(heap.begin(), heap.end());
    const PoseBlock first = heap.back();
    heap.pop_back();
    return first;
  }

  /// Adds a part of the block that was taken last; its bound is no higher.
  void push(const PoseBlock& block) {
    std::vector<PoseBlock>& heap = heaps_[block.bound];
    heap.push_back(block);
    if (is_heap_[block.bound]) std::push_heap(heap.begin(), heap.end());
  }

 private:
  std::vector<std::vector<PoseBlock>> heaps_;  ///< By bound.
  std::vector<bool> is_heap_;                  ///< By bound: whether its blocks are in the order of a heap yet.
  std::size_t highest_ = 0;                    ///< No block has a higher bound.
};

}  // namespace swiftlet::perception
