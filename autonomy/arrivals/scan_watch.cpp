#include "autonomy/arrivals/scan_watch.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::autonomy {

bool ScanWatch::repeats(const common::LaserScan& scan) {
  const bool any_return = std::any_of(scan.ranges_m.begin(), scan.ranges_m.end(), [&scan](float range_m) {
    return range_m >= scan.range_min_m && range_m < scan.range_max_m;
  });
  const bool same = any_return && scan.ranges_m == last_ranges_m_;
  const common::Edge edge = repeats_.update(same, scan.stamps.measured);
  if (edge == common::Edge::kEntered)
    log_.warn(scan.stamps.arrived, "laser", "the laser repeats its last scan: repeated scans are rejected");
  if (edge == common::Edge::kLeft) log_.info(scan.stamps.arrived, "laser", "the laser measures again");
  if (!same) last_ranges_m_ = scan.ranges_m;
  return same;
}

}  // namespace swiftlet::autonomy
