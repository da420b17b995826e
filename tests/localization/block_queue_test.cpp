// The queue of the search of the whole map against a single heap.
#include "perception/localization/block_queue.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace swiftlet::perception {
namespace {

PoseBlock blockBelow(std::uint16_t most) {
  return {static_cast<std::uint16_t>(*rc::gen::inRange<int>(0, most + 1)),
          static_cast<std::uint16_t>(*rc::gen::inRange(0, 4)), *rc::gen::inRange(0, 3), *rc::gen::inRange(0, 5),
          *rc::gen::inRange(0, 5)};
}

RC_GTEST_PROP(BlockQueueProperty, GivesTheBlocksInTheOrderOfOneHeap, ()) {
  std::vector<PoseBlock> blocks;
  for (int i = *rc::gen::inRange(0, 60); i > 0; --i) blocks.push_back(blockBelow(20));
  BlockQueue queue(blocks);
  std::make_heap(blocks.begin(), blocks.end());
  while (!queue.empty()) {
    RC_ASSERT(!blocks.empty());
    RC_ASSERT(queue.bound() == blocks.front().bound);
    const PoseBlock taken = queue.take();
    RC_ASSERT(!(taken < blocks.front()) && !(blocks.front() < taken));
    std::pop_heap(blocks.begin(), blocks.end());
    blocks.pop_back();
    if (taken.bound == 0) continue;
    for (int parts = *rc::gen::inRange(0, 3); parts > 0; --parts) {
      const PoseBlock part = blockBelow(static_cast<std::uint16_t>(taken.bound - 1));
      queue.push(part);
      blocks.push_back(part);
      std::push_heap(blocks.begin(), blocks.end());
    }
  }
  RC_ASSERT(blocks.empty());
}

TEST(BlockQueue, IsEmptyWithoutBlocks) { EXPECT_TRUE(BlockQueue({}).empty()); }

}  // namespace
}  // namespace swiftlet::perception
