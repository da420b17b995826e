// How far apart searches of the whole map come while the pose is not known. A vehicle that is in the map is found
// within a few metres of path (docs/localization.md); in a map of elsewhere every search is as heavy as all else
// together, and none can succeed.
#pragma once

#include <algorithm>
#include <cstddef>

#include "perception/localization/localizer_config.hpp"

namespace swiftlet::perception {

/// Path lengths are those of the odometer, in metres.
class SearchPatience {
 public:
  /// Searching begins here.
  void begin(double path_length_m) { hopeful_path_length_m_ = path_length_m; }

  /// A search from here found all places there are, so many. Few of them are worth going on as before; in a wrong map
  /// (fr079's log in the map of intel) no search came down to fewer than 59.
  void found(double path_length_m, std::size_t places) {
    constexpr std::size_t kFewPlaces = 20;
    if (places <= kFewPlaces) hopeful_path_length_m_ = path_length_m;
  }

  /// The search distance at first, then a share of the path searched in vain; at most the length of the local map, so
  /// that every stretch of the path is still compared with the map.
  double spacing_m(double path_length_m, const LocalizerConfig& config) const {
    constexpr double kPatience_m = 8.0, kSpacingShare = 0.25;
    const double in_vain_m = path_length_m - hopeful_path_length_m_ - kPatience_m;
    return std::clamp(kSpacingShare * in_vain_m, config.search_distance_m,
                      std::max(config.search_distance_m, config.local_map_length_m));
  }

 private:
  double hopeful_path_length_m_ = 0.0;
};

}  // namespace swiftlet::perception
