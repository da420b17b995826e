// A box of voxels with one bit each, so that whole rows of them are computed word by word.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swiftlet::mapping3d {

/// Reading beyond the box gives false. Bits of a row beyond its width are never set.
class BitVolume {
 public:
  using Word = std::uint64_t;
  static constexpr int kWordBits = 64;

  BitVolume() = default;
  /// All false. No side is negative.
  BitVolume(int width, int depth, int height);

  int width() const { return width_; }    ///< Voxels along x.
  int depth() const { return depth_; }    ///< Along y.
  int height() const { return height_; }  ///< Along z.

  bool contains(int x, int y, int z) const {
    return x >= 0 && y >= 0 && z >= 0 && x < width_ && y < depth_ && z < height_;
  }
  bool at(int x, int y, int z) const {
    return contains(x, y, z) && (words_[wordOf(x, y, z)] >> (x % kWordBits) & 1U) != 0;
  }
  /// The voxel must be in the box.
  void set(int x, int y, int z) { words_[wordOf(x, y, z)] |= Word{1} << (x % kWordBits); }
  void clear(int x, int y, int z) { words_[wordOf(x, y, z)] &= ~(Word{1} << (x % kWordBits)); }

  std::size_t wordsInRow() const { return row_words_; }
  /// The voxels along x, the lowest bit first. The row must be in the box.
  std::span<const Word> row(int y, int z) const { return {words_.data() + wordOf(0, y, z), row_words_}; }
  std::span<Word> row(int y, int z) { return {words_.data() + wordOf(0, y, z), row_words_}; }

  std::size_t count() const;

  /// Flips every voxel.
  void invert();
  /// The same with x and y exchanged.
  BitVolume transposed() const;
  /// Sets what is within `radius` voxels of a set one along all three axes: in a cube.
  void dilate(int radius);

 private:
  std::size_t wordOf(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(depth_) + static_cast<std::size_t>(y)) * row_words_ +
           static_cast<std::size_t>(x / kWordBits);
  }
  void clearBeyondRows();
  void dilateAcrossRows(std::size_t stride_words, int radius, std::size_t rows, std::size_t groups,
                        std::size_t group_words);

  int width_ = 0;
  int depth_ = 0;
  int height_ = 0;
  std::size_t row_words_ = 0;
  std::vector<Word> words_;
};

/// Calls take(begin, end) for each run of set bits of a row, in ascending order.
template <typename Take>
void forEachRun(std::span<const BitVolume::Word> row, Take&& take) {
  constexpr int kBits = BitVolume::kWordBits;
  int begin = -1;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const BitVolume::Word word = row[i];
    if (begin < 0 ? word == 0 : word == ~BitVolume::Word{0}) continue;
    const int first = static_cast<int>(i) * kBits;
    for (int bit = 0; bit < kBits; ++bit) {
      const bool set = (word >> bit & 1U) != 0;
      if (set == (begin >= 0)) continue;
      if (set) {
        begin = first + bit;
      } else {
        take(begin, first + bit);
        begin = -1;
      }
    }
  }
  if (begin >= 0) take(begin, static_cast<int>(row.size()) * kBits);
}

}  // namespace swiftlet::mapping3d
