#include "autonomy/arrivals/scan_watch.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::autonomy {
namespace {

/// A single scan given twice is a hiccup of a link and needs no event.
constexpr int kRun = 2;

}  // namespace

bool ScanWatch::repeats(const common::LaserScan& scan) {
  const bool any_return = std::any_of(scan.ranges_m.begin(), scan.ranges_m.end(), [&scan](float range_m) {
    return range_m >= scan.range_min_m && range_m < scan.range_max_m;
  });
  const bool same = any_return && scan.ranges_m == last_ranges_m_;
  if (same) {
    if (++repeated_ == kRun)
      log_.warn(scan.stamps.arrived, "laser", "the laser repeats its last scan, which counts as none");
    return true;
  }
  if (repeated_ >= kRun) log_.info(scan.stamps.arrived, "laser", "the laser measures again");
  repeated_ = 0;
  last_ranges_m_ = scan.ranges_m;
  return false;
}

}  // namespace swiftlet::autonomy
