#include "interfaces/rgbd/image_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swiftlet::interfaces {

using common::Time;

std::vector<ImagePair> pairsOf(const std::vector<Time>& colors, const std::vector<Time>& depths) {
  struct Candidate {
    double apart_s;
    ImagePair pair;
  };
  std::vector<Candidate> candidates;
  std::size_t first = 0;
  for (std::size_t c = 0; c < colors.size(); ++c) {
    while (first < depths.size() && (colors[c] - depths[first]).seconds() > kPairedWithin_s) ++first;
    for (std::size_t d = first; d < depths.size(); ++d) {
      const double apart_s = (depths[d] - colors[c]).seconds();
      if (apart_s > kPairedWithin_s) break;
      candidates.push_back({std::abs(apart_s), {c, d}});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.apart_s < b.apart_s; });
  std::vector<bool> used_colors(colors.size()), used_depths(depths.size());
  std::vector<ImagePair> pairs;
  for (const auto& [apart_s, pair] : candidates) {
    if (used_colors[pair.color] || used_depths[pair.depth]) continue;
    used_colors[pair.color] = used_depths[pair.depth] = true;
    pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end(), [](const ImagePair& a, const ImagePair& b) { return a.color < b.color; });
  return pairs;
}

double nearestPair_s(const std::vector<Time>& colors, const std::vector<Time>& depths) {
  double least_s = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0, d = 0; c < colors.size() && d < depths.size();) {
    const double later_s = (colors[c] - depths[d]).seconds();
    least_s = std::min(least_s, std::abs(later_s));
    ++(later_s < 0.0 ? c : d);
  }
  return least_s;
}

}  // namespace swiftlet::interfaces
