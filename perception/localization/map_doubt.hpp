// Whether the given map is that of this place. In the map of another place many places fit a part of what is seen, and
// none of them fits all of it; in the right map one place stands out within a metre or two, even if much has been
// moved. Private to localization.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "common/time.hpp"
#include "perception/localization/place_posterior.hpp"

namespace swiftlet::perception {

/// Page's cumulative sum test (1954), as LostTest is, over metres of path: the path to each search counts against the
/// map if no place fits, and for it if one is convincing. Rooms that look alike fit equally well and count as neither.
/// A hovering vehicle requests no search, so nothing is counted. The path flown while the map explained what
/// was seen counts for it as well: a vehicle that is lost afterwards must find no place for as long a path and more.
class MapDoubt {
 public:
  /// The places that a search found, the likeliest first, at that path length and time. `complete`: it was not given up
  /// before all places were found.
  void add(const std::vector<LikelyPlace>& places, bool complete, double path_length_m, common::Time now) {
    const double step_m = stepTo(path_length_m, now);
    // A search that was given up before it found any place is no evidence.
    if (places.empty() && !complete) return;
    // If nothing comes near, that says more than a place that almost fits.
    if (places.empty()) return count(2.0 * step_m);
    // A single place among few that were found is probable, too, when it hardly fits.
    const bool probable = places.front().probability >= kConvincingProbability;
    if (places.front().fit < (probable ? kMisfitting : kFitting))
      count(step_m);
    else if (probable && complete)
      count(-step_m);
  }
  /// The vehicle was localized on its path so far, and the map explained what was seen.
  void believe(double path_length_m, common::Time now) {
    if (last_) against_m_ -= std::max(0.0, path_length_m - last_->path_length_m);
    last_ = Search{path_length_m, now};
  }
  void reset() { *this = {}; }
  /// Becomes true when the evidence against the map is at its limit, and false when none is left.
  bool refuted() const { return refuted_; }

 private:
  // Measured: docs/decisions/localization.md#071.
  /// Path length without a fitting place, less that with a convincing one, from which on the map counts as that of
  /// another place.
  static constexpr double kRefutedAfter_m = 2.5;
  /// Mean value of the likelihood field at the local map at which a place fits it, however many others do.
  static constexpr double kFitting = 0.75;
  /// Mean value of the likelihood field at the local map below which no place fits, however probable it is among those
  /// that were found.
  static constexpr double kMisfitting = 0.65;
  /// A place that is this probable, and fits by more than kMisfitting, is convincing.
  static constexpr double kConvincingProbability = 0.95;

  struct Search {
    double path_length_m = 0.0;
    common::Time at;
  };

  void count(double against_m) {
    // Searches alone never make the sum negative, but they keep the credit of the path on which the map was accepted.
    const double least_m = std::min(against_m_, 0.0);
    against_m_ = std::clamp(against_m_ + against_m, least_m, kRefutedAfter_m);
    refuted_ = against_m_ >= kRefutedAfter_m || (refuted_ && against_m_ > 0.0);
  }

  /// The path since the last search. It counts more if the vehicle was slow, in narrow rooms for example, because
  /// it looked around meanwhile: so the time is bounded, too. When searches have become rare, a single one must not
  /// decide.
  double stepTo(double path_length_m, common::Time now) {
    constexpr double kLeast_m_s = 0.25, kMost_m = 1.0;
    const Search before = last_.value_or(Search{path_length_m, now});
    last_ = Search{path_length_m, now};
    const double slow_m = kLeast_m_s * (now - before.at).seconds();
    return std::clamp(std::max(path_length_m - before.path_length_m, slow_m), 0.0, kMost_m);
  }

  /// Path length without a fitting place, less that with one; negative after a path on which the map was accepted.
  double against_m_ = 0.0;
  std::optional<Search> last_;
  bool refuted_ = false;
};

}  // namespace swiftlet::perception
