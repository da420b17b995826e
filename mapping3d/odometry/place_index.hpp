// Which key frames look like a picture: an inverted index of binary words, with no pose known and no vocabulary
// learned.
//
// A word is twelve bits of a binary descriptor, and every descriptor has eight of them: two descriptors of the same
// corner, which differ in some bits, agree in at least one of the words almost always (locality-sensitive hashing,
// Indyk and Motwani, STOC 1998). A word counts by how few key frames have it (Sivic and Zisserman, "Video Google", ICCV
// 2003). The time of a query grows with the entries of its words, not with pairs of descriptors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "mapping3d/odometry/key_frame.hpp"

namespace swiftlet::mapping3d {

/// One thread. Deterministic.
class PlaceIndex {
 public:
  /// Key frames have numbers of the caller, each used once.
  void add(std::uint64_t number, const std::vector<DescribedPoint>& points);
  /// With the points that were added.
  void remove(std::uint64_t number, const std::vector<DescribedPoint>& points);

  /// The numbers of up to `greatest` key frames that share words with the points, the most similar first; of equal ones
  /// the newest number.
  std::vector<std::uint64_t> similar(const std::vector<DescribedPoint>& points, std::size_t greatest) const;

 private:
  static constexpr std::size_t kWordsPerPoint = 8;
  static constexpr std::size_t kWordBits = 12;
  static std::array<std::size_t, kWordsPerPoint> wordsOf(const vision::BinaryDescriptor& descriptor);

  /// The key frames that have a word, one entry for each point; empty before the first key frame.
  std::vector<std::vector<std::uint64_t>> entries_;
  std::map<std::uint64_t, std::size_t> points_;  ///< How many points a key frame has.
};

}  // namespace swiftlet::mapping3d
