// The spacing of searches of the whole map while the pose is not known. A vehicle that is in the map is found within a
// few metres of path (docs/localization.md). With a map of another place, each search costs as much as everything else
// together and cannot succeed.
#pragma once

#include <algorithm>
#include <cstddef>

#include "perception/localization/localizer_config.hpp"

namespace swiftlet::perception {

/// Path lengths are in metres, measured by the odometer.
class SearchPatience {
 public:
  /// Starts searching at this path length.
  void begin(double path_length_m) { hopeful_path_length_m_ = path_length_m; }

  /// Reports a search at this path length that found all places, and their number. If they are few, searching continues
  /// at the short spacing. With a wrong map (fr079's log in the map of intel) no search found fewer than 59.
  void found(double path_length_m, std::size_t places) {
    constexpr std::size_t kFewPlaces = 20;
    if (places <= kFewPlaces) hopeful_path_length_m_ = path_length_m;
  }

  /// The search distance at first, later a share of the path that was searched without success. At most the length of
  /// the local map, so that every part of the path is still compared with the map.
  double spacing_m(double path_length_m) const {
    // In its map a vehicle is found within a few metres. With a spacing of a quarter of the path, the number of
    // searches grows only with the logarithm of the path.
    constexpr double kPatience_m = 8.0, kSpacingShare = 0.25;
    constexpr double kLeast_m = 0.4;  // Path length after which the whole map is searched again.
    const double in_vain_m = path_length_m - hopeful_path_length_m_ - kPatience_m;
    return std::clamp(kSpacingShare * in_vain_m, kLeast_m, std::max(kLeast_m, LocalizerConfig::local_map_length_m));
  }

 private:
  double hopeful_path_length_m_ = 0.0;
};

}  // namespace swiftlet::perception
