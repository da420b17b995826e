// The priority queue of D* Lite: a 4-ary heap. Each vertex stores its position in the heap, so that it can be moved or
// removed.
#include <algorithm>

#include "planning/search/dstar_lite.hpp"

namespace swiftlet::planning {
namespace {
constexpr std::size_t kChildren = 4;
}

void DStarLite::insert(std::int32_t index, Key key) {
  heap_.push_back({key, index});
  siftUp(heap_.size() - 1, {key, index});
}

void DStarLite::remove(Vertex& vertex) {
  const auto place = static_cast<std::size_t>(vertex.place);
  vertex.place = -1;
  const Entry last = heap_.back();
  heap_.pop_back();
  if (place == heap_.size()) return;
  if (place > 0 && last.key < heap_[(place - 1) / kChildren].key)
    siftUp(place, last);
  else
    siftDown(place, last);
}

void DStarLite::siftUp(std::size_t place, Entry entry) {
  while (place > 0) {
    const std::size_t parent = (place - 1) / kChildren;
    if (heap_[parent].key <= entry.key) break;
    heap_[place] = heap_[parent];
    vertices_[static_cast<std::size_t>(heap_[place].index)].place = static_cast<std::int32_t>(place);
    place = parent;
  }
  heap_[place] = entry;
  vertices_[static_cast<std::size_t>(entry.index)].place = static_cast<std::int32_t>(place);
}

void DStarLite::siftDown(std::size_t place, Entry entry) {
  const std::size_t size = heap_.size();
  while (true) {
    const std::size_t first = place * kChildren + 1;
    if (first >= size) break;
    std::size_t least = first;
    if (first + kChildren <= size) {
      // Which child is the least cannot be predicted: selected without a branch.
      const Entry* child = &heap_[first];
      const std::size_t left = child[1].key < child[0].key ? 1 : 0, right = child[3].key < child[2].key ? 3 : 2;
      least += child[right].key < child[left].key ? right : left;
    } else {
      for (std::size_t child = first + 1; child < size; ++child)
        if (heap_[child].key < heap_[least].key) least = child;
    }
    if (heap_[least].key >= entry.key) break;
    heap_[place] = heap_[least];
    vertices_[static_cast<std::size_t>(heap_[place].index)].place = static_cast<std::int32_t>(place);
    place = least;
  }
  heap_[place] = entry;
  vertices_[static_cast<std::size_t>(entry.index)].place = static_cast<std::int32_t>(place);
}

}  // namespace swiftlet::planning
