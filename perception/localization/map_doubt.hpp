// Whether the given map is that of this place. In the map of another place many places fit a part of what is seen, and
// none of them fits all of it; in the right map one place stands out within a metre or two, even if much has been
// moved. Private to localization.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "perception/localization/localizer_config.hpp"
#include "perception/localization/place_posterior.hpp"

namespace swiftlet::perception {

/// Page's cumulative sum test (1954), as LostTest is, over metres of path: the path to each search counts against the
/// map if no place fits, and for it if one is convincing. A vehicle that hovers learns nothing, so nothing is counted;
/// rooms that look alike fit equally well, which counts neither way. For a vehicle that has not been localized yet.
class MapDoubt {
 public:
  /// The places that a search at `path_length_m` found, the likeliest first.
  void add(const LocalizerConfig& config, const std::vector<LikelyPlace>& places, double path_length_m) {
    // Far apart, when searches have become rare, a single one must not decide.
    constexpr double kMost_m = 1.0;
    const double step_m = std::clamp(path_length_m - path_length_m_.value_or(path_length_m), 0.0, kMost_m);
    path_length_m_ = path_length_m;
    if (!places.empty() && places.front().probability >= config.convincing_probability)
      against_m_ -= step_m;
    else if (places.empty() || places.front().fit < config.fitting)
      against_m_ += step_m;
    against_m_ = std::clamp(against_m_, 0.0, config.refuted_after_m);
    refuted_ = against_m_ >= config.refuted_after_m || (refuted_ && against_m_ > 0.0);
  }
  void reset() { *this = {}; }
  /// From the moment when all is against the map, until nothing is.
  bool refuted() const { return refuted_; }

 private:
  double against_m_ = 0.0;               ///< Path over which no place fitted, in excess of that over which one did.
  std::optional<double> path_length_m_;  ///< At the last search.
  bool refuted_ = false;
};

}  // namespace swiftlet::perception
