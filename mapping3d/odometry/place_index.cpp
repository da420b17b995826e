#include "mapping3d/odometry/place_index.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet::mapping3d {

/// Each word has a range of indices of its own: the same bits elsewhere in a descriptor are another word.
std::array<std::size_t, PlaceIndex::kWordsPerPoint> PlaceIndex::wordsOf(const vision::BinaryDescriptor& descriptor) {
  std::array<std::size_t, kWordsPerPoint> words{};
  for (std::size_t i = 0; i < kWordsPerPoint; ++i) {
    const std::uint64_t bits = descriptor.bits[i / 2] >> (kWordBits * (i % 2));
    words[i] = (i << kWordBits) + static_cast<std::size_t>(bits & ((std::uint64_t{1} << kWordBits) - 1));
  }
  return words;
}

void PlaceIndex::add(std::uint64_t number, const std::vector<DescribedPoint>& points) {
  if (entries_.empty()) entries_.resize(kWordsPerPoint << kWordBits);
  points_[number] = points.size();
  for (const DescribedPoint& point : points)
    for (const std::size_t word : wordsOf(point.descriptor)) entries_[word].push_back(number);
}

void PlaceIndex::remove(std::uint64_t number, const std::vector<DescribedPoint>& points) {
  points_.erase(number);
  for (const DescribedPoint& point : points)
    for (const std::size_t word : wordsOf(point.descriptor)) std::erase(entries_[word], number);
}

std::vector<std::uint64_t> PlaceIndex::similar(const std::vector<DescribedPoint>& points, std::size_t greatest) const {
  if (entries_.empty()) return {};
  std::map<std::uint64_t, double> votes;
  for (const DescribedPoint& point : points)
    for (const std::size_t word : wordsOf(point.descriptor)) {
      const std::vector<std::uint64_t>& entries = entries_[word];
      if (entries.empty()) continue;
      const double rarity = std::log1p(static_cast<double>(points_.size()) / static_cast<double>(entries.size()));
      for (const std::uint64_t number : entries) votes[number] += rarity;
    }
  std::vector<std::pair<double, std::uint64_t>> ranked;
  for (const auto& [number, sum] : votes)
    ranked.emplace_back(sum / std::sqrt(static_cast<double>(points_.at(number))), number);
  std::sort(ranked.begin(), ranked.end(), std::greater<>());
  std::vector<std::uint64_t> numbers;
  for (std::size_t i = 0; i < std::min(greatest, ranked.size()); ++i) numbers.push_back(ranked[i].second);
  return numbers;
}

}  // namespace swiftlet::mapping3d
