#include "mapping3d/voxels/bit_volume.hpp"

#include <algorithm>
#include <bit>

namespace swiftlet::mapping3d {
namespace {

/// The row shifted by one voxel towards greater and towards smaller x, added to it.
void widen(std::span<BitVolume::Word> row) {
  BitVolume::Word before = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const BitVolume::Word word = row[i], next = i + 1 < row.size() ? row[i + 1] : 0;
    row[i] = word | word << 1 | before >> (BitVolume::kWordBits - 1) | word >> 1 | next << (BitVolume::kWordBits - 1);
    before = word;
  }
}

}  // namespace

BitVolume::BitVolume(int width, int depth, int height)
    : width_(width),
      depth_(depth),
      height_(height),
      row_words_(static_cast<std::size_t>((width + kWordBits - 1) / kWordBits)),
      words_(row_words_ * static_cast<std::size_t>(depth) * static_cast<std::size_t>(height), 0) {}

std::size_t BitVolume::count() const {
  std::size_t count = 0;
  for (const Word word : words_) count += static_cast<std::size_t>(std::popcount(word));
  return count;
}

void BitVolume::invert() {
  for (Word& word : words_) word = ~word;
  clearBeyondRows();
}

void BitVolume::clearBeyondRows() {
  if (width_ % kWordBits == 0) return;
  const Word used = (Word{1} << (width_ % kWordBits)) - 1;
  for (std::size_t last = row_words_ - 1; last < words_.size(); last += row_words_) words_[last] &= used;
}

BitVolume BitVolume::transposed() const {
  BitVolume result(depth_, width_, height_);
  for (int z = 0; z < height_; ++z)
    for (int y = 0; y < depth_; ++y)
      forEachRun(row(y, z), [&](int begin, int end) {
        for (int x = begin; x < end; ++x) result.set(y, x, z);
      });
  return result;
}

void BitVolume::dilate(int radius) {
  for (int step = 0; step < radius; ++step)
    for (int z = 0; z < height_; ++z)
      for (int y = 0; y < depth_; ++y) widen(row(y, z));
  clearBeyondRows();
  const auto depth = static_cast<std::size_t>(depth_), height = static_cast<std::size_t>(height_);
  dilateAcrossRows(row_words_, radius, depth, height, depth * row_words_);
  dilateAcrossRows(depth * row_words_, radius, height, depth, row_words_);
}

/// In each of the groups, rows that lie `stride_words` apart get what the rows within the radius have.
void BitVolume::dilateAcrossRows(std::size_t stride_words, int radius, std::size_t rows, std::size_t groups,
                                 std::size_t group_words) {
  std::vector<Word> before(row_words_), now(row_words_);
  for (int step = 0; step < radius; ++step) {
    for (std::size_t group = 0; group < groups; ++group) {
      std::fill(before.begin(), before.end(), 0);
      for (std::size_t i = 0; i < rows; ++i) {
        Word* words = words_.data() + group * group_words + i * stride_words;
        std::copy_n(words, row_words_, now.begin());
        for (std::size_t k = 0; k < row_words_; ++k)
          words[k] = now[k] | before[k] | (i + 1 < rows ? words[k + stride_words] : 0);
        before.swap(now);
      }
    }
  }
}

}  // namespace swiftlet::mapping3d
