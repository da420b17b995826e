// Whether the given map is that of this place. In the map of another place many places explain a part of what is seen
// and none of them much of it; in the right one a place stands out within some metres, even if much has been moved.
#pragma once

#include <vector>

#include "perception/localization/localizer_config.hpp"
#include "perception/localization/place_posterior.hpp"

namespace swiftlet::perception {

/// For a vehicle that has not been localized yet.
class MapDoubt {
 public:
  /// The places that a search found, the likeliest first, `path_length_m` from the start.
  void add(const LocalizerConfig& config, const std::vector<LikelyPlace>& places, double path_length_m) {
    const bool stands_out = !places.empty() && (places.front().explained >= config.convincing_explained ||
                                                places.front().probability >= config.convincing_probability);
    searches_ = stands_out || path_length_m < config.refuted_after_m ? 0 : searches_ + 1;
    refuted_ = searches_ >= config.refuted_searches;
  }
  void reset() { *this = {}; }
  bool refuted() const { return refuted_; }

 private:
  int searches_ = 0;  ///< In a row, in which no place stood out.
  bool refuted_ = false;
};

}  // namespace swiftlet::perception
